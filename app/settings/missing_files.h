/// Files and time zones that the settings name but that are missing; calibrations that are not used; remarks on
/// the shape of a solid prop.
///
/// The settings are valid without them: an exhibit shows the packs that are there, and a pack may be baked after
/// the settings are written. So missing files are reported, not refused; a part that cannot work without a file
/// refuses by itself.
///
/// Errors   none; a file that cannot be accessed counts as missing.
/// Threads  any; looks at the file system.
#pragma once

#include "app/settings/settings.h"

#include <string>
#include <vector>

namespace frustumscreen::settings {

/// One sentence for each: where the settings name it, its path, what to do. A recording counts only if it is
/// replayed.
[[nodiscard]] std::vector<std::string> missing_files(const Settings& settings);

} // namespace frustumscreen::settings
