/// Cuts a description into portions, which are shown one after the other while the description is spoken or read.
///
/// A portion has as many whole sentences as fit the length of a caption; a longer sentence is cut at its commas,
/// else between words. The bake sets each portion as a text of its own, and the kiosk finds the same portions in
/// the plain text.
///
/// Text     UTF-8 that fault_of_text accepts. Portions are parts of the text in their order, without white space
///          around them.
/// Threads  pure; any.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace frustumscreen::pack {

/// A recording takes at most three minutes; this many portions take about six to read.
inline constexpr std::size_t max_text_portions = 32;

[[nodiscard]] std::vector<std::string> portions_of(std::string_view text);
/// The key of a portion among a pack's set texts.
[[nodiscard]] std::string portion_key(std::size_t portion);

/// Time for a visitor to read the text, without finding its beginning: 15 letters a second, or 5 of Chinese,
/// Japanese and Korean. It is also the measure of how long the text is spoken.
[[nodiscard]] double reading_time_s(std::string_view text);

} // namespace frustumscreen::pack
