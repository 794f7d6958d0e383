/// frustumscreen-bake --words: the exhibit's own words into one file for the kiosk.
///
/// Threads  the main one.
#pragma once

namespace frustumscreen {

/// Whether the command line asks for it.
[[nodiscard]] bool asks_for_words(int argc, const char* const* argv);

/// The exit status.
[[nodiscard]] int words_command(int argc, char** argv);

} // namespace frustumscreen
