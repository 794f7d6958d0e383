/// Checks a text that a person wrote before it is shaped, spoken or stored.
///
/// Text     UTF-8 in lines of '\n'. Refused are control characters, other line separators, and what overrides the order of
///          letters (U+202A to U+202E): a text must read as it is stored. Isolates (U+2066 to U+2069) and marks are allowed.
/// Errors   one sentence: what, at which line and letter, what to do.
/// Threads  pure; any.
/// Source   Unicode Standard Annex #9; Boucher and Anderson, Trojan Source, 2023.
#pragma once

#include "firmware_host/base/result.h"

#include <cstddef>
#include <string>
#include <string_view>

namespace frustumscreen {

inline constexpr std::size_t most_shaped_bytes = 100000;
inline constexpr std::size_t most_written_lines = 200;

[[nodiscard]] Result<void> check_shaped_text(std::string_view text);

/// The code point of the UTF-8 character that `text` begins with; `text` must have been checked.
[[nodiscard]] char32_t code_point_of(std::string_view text);

/// `'x' (U+0078)`, for a message.
[[nodiscard]] std::string named_letter(char32_t code_point);

} // namespace frustumscreen
