/// Has tables drawn by draw_plots.py, which lies beside the program that the bench is.
///
/// Errors   what the script says: one line, as where Debian's python3-matplotlib is missing; a script that is
/// not
///          there or does not run.
/// Threads  one; waits for the script.
#pragma once

#include "firmware_host/base/result.h"

#include <filesystem>
#include <string>
#include <vector>

namespace frustumscreen {

/// Where the build leaves the script, seen from the program that runs.
[[nodiscard]] std::filesystem::path plot_script();

/// `arguments` as the script has them: tables, each drawn as an SVG beside it, or --overall OUT.svg FOLDER...
[[nodiscard]] Result<void> draw_tables(const std::filesystem::path& script,
                                       const std::vector<std::string>& arguments);

} // namespace frustumscreen
