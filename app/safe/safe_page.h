/// Layout of the safe picture: words for visitors in each language, and below them, smaller, for the staff.
///
/// Frame    pixels of the picture, x to the right, y down from its top left corner.
/// Shape    any size; everything is inside a margin, so the picture's corner stays black for the probe code.
/// Errors   none: a reason with unknown characters is shown with replacements.
/// Threads  pure; any.
#pragma once

#include "app/safe/safe_words.h"

#include <chrono>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace frustumscreen::safe {

/// The variable texts of a safe picture.
struct SafeText {
    std::string reason;                 ///< one sentence, UTF-8; empty: unknown
    std::chrono::minutes since_boot{0}; ///< of the machine
    [[nodiscard]] bool operator==(const SafeText&) const = default;
};

/// One glyph in the picture.
struct PlacedLetter {
    std::uint16_t box = 0;
    float x = 0.0F, y = 0.0F; ///< of the pen
    float em_px = 0.0F;       ///< type size
    std::uint8_t grey = 0;    ///< sRGB code
};

struct SafePage {
    int width = 0, height = 0;
    std::vector<PlacedLetter> letters;
};

/// All languages of the program, in their order.
[[nodiscard]] std::vector<std::string_view> safe_languages();

/// `languages`: those for visitors, at least one; the first one is also used for the staff's instructions.
[[nodiscard]] SafePage lay_out_safe_page(int width, int height, const SafeText& text,
                                         const std::vector<std::string_view>& languages);

/// The first line of `bytes`: characters without a baked letter become U+FFFD, white space becomes single
/// spaces, and the text is cut to `longest_reason` characters.
[[nodiscard]] std::u32string shown_reason(std::string_view bytes);
inline constexpr std::size_t longest_reason = 300;

/// "3 h 12 min".
[[nodiscard]] std::string in_hours(std::chrono::minutes time);

} // namespace frustumscreen::safe
