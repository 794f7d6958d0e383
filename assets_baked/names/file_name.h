/// Whether two names mean the same file on somebody's computer.
///
/// Method   both are folded: Windows-1252 where the bytes are no UTF-8, then Unicode's normal form C (UAX 15) and full case folding. macOS
///          writes names decomposed, Windows ignores their case, old exporters write Windows-1252.
/// Library  GLib.
/// Threads  pure; any.
#pragma once

#include <string>
#include <string_view>

namespace frustumscreen {

/// The form in which the names of one file are equal. A name that is neither UTF-8 nor Windows-1252 stays as it is.
[[nodiscard]] std::string folded_file_name(std::string_view name);
[[nodiscard]] bool is_same_file_name(std::string_view a, std::string_view b);

} // namespace frustumscreen
