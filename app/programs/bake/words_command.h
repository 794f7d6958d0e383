/// frustumscreen-bake --words: puts the exhibit's own words into one file for the kiosk.
///
/// Threads  the main one.
#pragma once

namespace frustumscreen::programs {

/// Returns the exit status.
[[nodiscard]] int words_command(int argc, char** argv);

} // namespace frustumscreen::programs
