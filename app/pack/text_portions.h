/// Cuts a description into portions, which are shown one after the other while it is spoken or read.
///
/// A portion is as many whole sentences as are no longer than a caption; a longer sentence is cut at its commas, else between
/// words. The bake sets each portion as a text of its own, and the kiosk finds the same portions in the plain text.
///
/// Text     UTF-8, as fault_of_text lets it pass. Portions are parts of it in their order, without white space around them.
/// Threads  pure; any.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace frustumscreen {

/// A recording is no longer than three minutes, and these are read in about six.
inline constexpr std::size_t most_text_portions = 32;

[[nodiscard]] std::vector<std::string> portions_of(std::string_view text);
/// The key of a portion among a pack's set texts.
[[nodiscard]] std::string portion_key(std::size_t portion);

/// How long a visitor reads it, without the time to find its beginning: 15 letters a second, 5 of those of Chinese, Japanese
/// and Korean. It is also the measure for how long it is spoken.
[[nodiscard]] double reading_time_s(std::string_view text);

} // namespace frustumscreen
