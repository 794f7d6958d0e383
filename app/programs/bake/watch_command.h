/// frustumscreen-bake --watch: bakes a coarse preview of a folder again after each change of a file in it.
///
/// Threads  the main one. Each bake is a process of its own, so that a crash of one does not end the watching.
#pragma once

namespace frustumscreen::programs {

/// Runs until SIGINT or SIGTERM; returns the exit status.
[[nodiscard]] int watch_command(int argc, char** argv);

} // namespace frustumscreen::programs
