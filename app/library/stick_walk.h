/// Which files of a stick are looked at: `*.fspack` in its root or one folder down, and the set file in its root.
///
/// Passed over  names that begin with a dot (macOS's `._*` twins among them), recycle bins, what systems keep for themselves.
/// Misnamed     a set file that is called nearly so, or lies in a folder, is told, where there is none that is called so.
/// Errors       a stick with too many entries, one that cannot be read or takes too long: the stick as a whole.
/// Threads      one caller.
#pragma once

#include "app/library/import_failure.h"
#include "app/library/import_limits.h"
#include "app/library/import_report.h"
#include "firmware_host/base/file_tree.h"

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace frustumscreen {

struct StickFiles {
    std::vector<std::string> packs;    ///< paths, in the order of their names
    std::vector<ImportedPack> refused; ///< folders that cannot be read, packs that are no files
    std::optional<ImportedPack>
        misnamed; ///< of what may be meant as set file, the first by name; none if there is one
    std::optional<ImportedPack> misnamed_settings; ///< the same of a kiosk's settings
    bool has_exhibit_file = false;
};

/// Whether nothing of this name is ever looked at.
[[nodiscard]] bool is_passed_over(std::string_view name);

/// `too_late` is asked after every entry.
[[nodiscard]] tl::expected<StickFiles, ImportFailure> walk_stick(FileTree& stick, const ImportLimits& limits,
                                                                 const std::function<bool()>& too_late);

} // namespace frustumscreen
