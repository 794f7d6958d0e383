/// Files and time zones that the settings name and that are not there.
///
/// The settings themselves are right without them: an exhibit shows the packs that there are, and a pack may be baked
/// after the settings are written. So this is said, not refused; what cannot go on without a file refuses by itself.
///
/// Errors   none; a file that cannot be looked at counts as missing.
/// Threads  any; looks at the file system.
#pragma once

#include "app/settings/settings.h"

#include <string>
#include <vector>

namespace frustumscreen {

/// One sentence for each: where the settings name it, its path, what to do. A recording counts where it is replayed.
[[nodiscard]] std::vector<std::string> missing_files(const Settings& settings);

} // namespace frustumscreen
