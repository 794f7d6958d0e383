/// Draws tables with draw_plots.py, which lies beside the bench's program.
///
/// Errors   what the script says, in one line, for example that Debian's python3-matplotlib is missing; a
///          script that is not there or does not run.
/// Threads  one; waits for the script.
#pragma once

#include "firmware_host/base/result.h"

#include <filesystem>
#include <string>
#include <vector>

namespace frustumscreen {

/// Where the build puts the script, from the path of the running program.
[[nodiscard]] std::filesystem::path plot_script();

/// `arguments` as the script has them: tables, each drawn as an SVG beside it, or --overall OUT.svg FOLDER...
[[nodiscard]] Result<void> draw_tables(const std::filesystem::path& script,
                                       const std::vector<std::string>& arguments);

} // namespace frustumscreen
