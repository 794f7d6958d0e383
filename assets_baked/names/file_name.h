/// Compares file names as some person's computer would: two names that mean the same file there are equal.
///
/// Method   both names are folded: from Windows-1252 if the bytes are not UTF-8, then to Unicode's normal form C (UAX
///          15) and by full case folding. macOS writes names decomposed, Windows ignores their case, old exporters
///          write Windows-1252.
/// Library  GLib.
/// Threads  pure; any.
#pragma once

#include <string>
#include <string_view>

namespace frustumscreen::names {

/// The folded form, equal for all names of one file. A name that is neither UTF-8 nor Windows-1252 is unchanged.
[[nodiscard]] std::string folded_file_name(std::string_view name);
[[nodiscard]] bool is_same_file_name(std::string_view a, std::string_view b);

} // namespace frustumscreen::names
