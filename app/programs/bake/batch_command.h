/// frustumscreen-bake --batch: bakes a folder of objects into a folder of packs and writes a report.
///
/// Threads  the main one, and one for each bake in progress.
#pragma once

namespace frustumscreen::programs {

/// Returns the exit status: 1 if any object failed.
[[nodiscard]] int batch_command(int argc, char** argv);

} // namespace frustumscreen::programs
