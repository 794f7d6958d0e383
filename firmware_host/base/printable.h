/// Text from outside: whether it is well-formed, and as it may stand in a message or on a terminal.
///
/// Threads  pure; any.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace frustumscreen {

/// Of the first UTF-8 character of `text`, which is not empty; 0 if it begins with none.
[[nodiscard]] std::size_t character_bytes(std::string_view text);
/// Whether the one character `character` is for terminals and not for readers: C0, DEL, C1.
[[nodiscard]] bool is_control(std::string_view character);

/// One line of at most `longest` bytes, whole characters: what is no character, or one that a terminal acts
/// on, is a '?'. A longer text ends in "...".
[[nodiscard]] std::string printable(std::string_view text, std::size_t longest = 100);

} // namespace frustumscreen
