/// frustumscreen-bake --check: reports of scans what they contain, what a bake would lose, and roughly what it would make.
///
/// Threads  the main one.
#pragma once

namespace frustumscreen::programs {

/// Returns the exit status: 0 if all scans can be baked, 1 if one cannot, 2 for wrong use.
[[nodiscard]] int check_command(int argc, char** argv);

} // namespace frustumscreen::programs
