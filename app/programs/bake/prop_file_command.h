/// frustumscreen-bake --prop-file: makes a prop file, a plain OBJ in millimetres, from an STL, PLY or OBJ file.
///
/// Threads  the main one.
#pragma once

namespace frustumscreen::programs {

/// Returns the exit status.
[[nodiscard]] int prop_file_command(int argc, char** argv);

} // namespace frustumscreen::programs
