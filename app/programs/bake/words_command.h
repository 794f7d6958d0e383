/// frustumscreen-bake --words: the exhibit's own words into one file for the kiosk.
///
/// Threads  the main one.
#pragma once

namespace frustumscreen {

/// The exit status.
[[nodiscard]] int words_command(int argc, char** argv);

} // namespace frustumscreen
