/// Checks text from outside and makes it safe for a message or a terminal.
///
/// Threads  pure; any.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace frustumscreen {

/// Bytes of the first UTF-8 character of `text`, which must not be empty; 0 if it is not valid UTF-8.
[[nodiscard]] std::size_t character_bytes(std::string_view text);
/// Whether the single character `character` is a control character: C0, DEL or C1.
[[nodiscard]] bool is_control(std::string_view character);

/// Whether the single character `character` ends a line, or embeds or overrides a text direction, which would
/// move or reverse the following text: U+2028 to U+202E.
[[nodiscard]] bool directs_lines(std::string_view character);

/// `text` as one line of at most `longest` bytes, cut between characters. Control characters, characters of
/// `directs_lines` and invalid bytes become '?'; a cut text ends in "...".
[[nodiscard]] std::string printable(std::string_view text, std::size_t longest = 100);

} // namespace frustumscreen
