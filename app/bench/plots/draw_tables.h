/// Draws tables with draw_plots.py, which is installed next to the bench's program.
///
/// Errors   the script's message in one line, for example that Debian's python3-matplotlib is missing; a
///          script that is missing or does not run.
/// Threads  one; waits for the script.
#pragma once

#include "firmware_host/base/result.h"

#include <filesystem>
#include <string>
#include <vector>

namespace frustumscreen::bench {

/// Path of the script in the build, derived from the running program's path.
[[nodiscard]] std::filesystem::path plot_script();

/// `arguments` of the script: tables, each drawn as an SVG next to it, or --overall OUT.svg FOLDER...
[[nodiscard]] Result<void> draw_tables(const std::filesystem::path& script,
                                       const std::vector<std::string>& arguments);

} // namespace frustumscreen::bench
