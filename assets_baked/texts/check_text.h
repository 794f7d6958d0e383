/// Checks a text written by a person before it is shaped, spoken or stored.
///
/// Text     UTF-8 in lines of '\n'. Control characters, other line separators and characters that override
///          the order of letters (U+202A to U+202E) are refused: a text must read as it is stored. Isolates
///          (U+2066 to U+2069) and marks are allowed.
/// Errors   one sentence: problem, line and letter, remedy.
/// Threads  pure; any.
/// Source   Unicode Standard Annex #9; Boucher and Anderson, Trojan Source, 2023.
#pragma once

#include "firmware_host/base/result.h"

#include <cstddef>
#include <string>
#include <string_view>

namespace frustumscreen::texts {

inline constexpr std::size_t max_shaped_bytes = 100000;
inline constexpr std::size_t max_written_lines = 200;

[[nodiscard]] Result<void> check_shaped_text(std::string_view text);

/// The code point of the UTF-8 character at the beginning of `text`; `text` must have been checked.
[[nodiscard]] char32_t code_point_of(std::string_view text);

/// `'x' (U+0078)`, for a message.
[[nodiscard]] std::string named_letter(char32_t code_point);

} // namespace frustumscreen::texts
