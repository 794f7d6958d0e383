/// frustumscreen-bake --batch: a folder of objects into a folder of packs, with a report.
///
/// Threads  the main one, and one for each bake at a time.
#pragma once

namespace frustumscreen {

/// The exit status: 1 if one object failed.
[[nodiscard]] int batch_command(int argc, char** argv);

} // namespace frustumscreen
