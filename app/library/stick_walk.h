/// Finds the files of a stick that count: `*.fspack` in its root or one folder down, and the set file in its root.
///
/// Passed over  names that begin with a dot (such as macOS's `._*` twins), recycle bins, the operating systems' own
///              folders.
/// Misnamed     a file nearly named like the set file, or in a folder, is reported if no file has the right name
///              and place.
/// Errors       too many entries, a read error, too long a time: the stick as a whole.
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

namespace frustumscreen::library {

struct StickFiles {
    std::vector<std::string> packs;    ///< paths, in the order of their names
    std::vector<ImportedPack> refused; ///< unreadable folders, and packs that are not files
    std::optional<ImportedPack>
        misnamed; ///< a file that may be meant as set file, the first by name; none if there is a set file
    std::optional<ImportedPack> misnamed_settings; ///< the same for a kiosk's settings
    std::optional<ImportedPack> misnamed_request;  ///< the same for the request for a report
    std::vector<ImportedPack> misnamed_copy; ///< the same for the request for a kiosk's copy, and for a copy
    bool has_exhibit_file = false;
};

/// True if a file or folder of this name is always ignored.
[[nodiscard]] bool is_ignored(std::string_view name);

/// `too_late` is asked after every entry.
[[nodiscard]] tl::expected<StickFiles, ImportFailure> walk_stick(FileTree& stick, const ImportLimits& limits,
                                                                 const std::function<bool()>& too_late);

} // namespace frustumscreen::library
