/// The set that the exhibit starts with, where one is installed.
///
/// A set on trial of which a pack cannot be shown makes way for the one before, at once. Where that cannot be shown either, the
/// verdict stays as it was.
///
/// Threads  the render thread, before the first frame.
/// Errors   no installed set can be shown: then there is no show, and the packs of the settings are to be tried.
#pragma once

#include "app/show/artifact_show.h"
#include "app/show/library_files.h"
#include "firmware_host/base/result.h"

#include <functional>
#include <memory>
#include <optional>

namespace frustumscreen {

/// The settings name a folder that there is: a set is installed there, or may come to be.
[[nodiscard]] bool library_is_there(const Settings& settings);

struct InstalledShow {
    std::unique_ptr<ArtifactShow> show; ///< none: no set is installed, or none that can be shown
    LibraryStart start;
};
/// `options`: what is the same for every set. `create`: ArtifactShow::create of these.
[[nodiscard]] InstalledShow show_installed_set(
    const Settings& settings, const ArtifactShowOptions& options, Trust trust,
    const std::function<Result<std::unique_ptr<ArtifactShow>>(const ArtifactShowOptions&)>& create);

} // namespace frustumscreen
