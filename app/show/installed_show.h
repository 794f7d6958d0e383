/// The installed set that the exhibit starts with.
///
/// If a pack of a set on trial cannot be shown, the previous set is shown at once. If that cannot be shown either,
/// the verdict stays unchanged.
///
/// Threads  the render thread, before the first frame.
/// Errors   no installed set can be shown: then `show` is null, and the caller tries the packs of the settings.
#pragma once

#include "app/show/artifact_show.h"
#include "app/show/library_files.h"
#include "firmware_host/base/result.h"

#include <functional>
#include <memory>

namespace frustumscreen::show {

/// True if the folder that the settings name exists: a set is installed there, or may be later.
[[nodiscard]] bool library_is_there(const settings::Settings& settings);

struct InstalledShow {
    std::unique_ptr<ArtifactShow> show; ///< null: no set is installed, or none can be shown
    LibraryStart start;
};
/// `options`: those common to all sets. `create`: calls ArtifactShow::create with them.
[[nodiscard]] InstalledShow show_installed_set(
    const settings::Settings& settings, const ArtifactShowOptions& options, Trust trust,
    const std::function<Result<std::unique_ptr<ArtifactShow>>(const ArtifactShowOptions&)>& create);

} // namespace frustumscreen::show
