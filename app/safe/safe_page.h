/// What the safe picture says and where: for visitors in each language, and below, smaller, for the staff.
///
/// Frame    pixels of the picture, x to the right, y down from its top left corner.
/// Shape    any size; everything lies inside a margin, so the picture's corner stays black for the probe's code.
/// Errors   none: a reason that cannot be shown as it is is shown as far as it can be.
/// Threads  pure; any.
#pragma once

#include "app/safe/safe_words.h"

#include <chrono>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace frustumscreen {

/// What changes from one safe picture to the next.
struct SafeText {
    std::string reason;                 ///< one sentence, UTF-8; empty: none is known
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

/// All languages that the program has words in, in their order.
[[nodiscard]] std::vector<std::string_view> safe_languages();

/// `languages`: those for visitors, at least one; the first one's words tell the staff what to do.
[[nodiscard]] SafePage lay_out_safe_page(int width, int height, const SafeText& text,
                                         const std::vector<std::string_view>& languages);

/// The first line of `bytes`, with what no baked letter shows replaced by U+FFFD, white space by single spaces, and cut to
/// `longest_reason` characters.
[[nodiscard]] std::u32string shown_reason(std::string_view bytes);
inline constexpr std::size_t longest_reason = 300;

/// "3 h 12 min".
[[nodiscard]] std::string in_hours(std::chrono::minutes time);

} // namespace frustumscreen
