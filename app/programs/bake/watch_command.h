/// frustumscreen-bake --watch: bakes a coarse preview of a folder again whenever a file in it has changed.
///
/// Threads  the main one. Each bake is a process of its own, so that none can end the watching.
#pragma once

namespace frustumscreen {

/// Until SIGINT or SIGTERM; the exit status.
[[nodiscard]] int watch_command(int argc, char** argv);

} // namespace frustumscreen
