/// Words on the table during a calibration, by touch, by a camera or by eye: how they are set, in English and in the house's language, and the
/// dots that count what is done.
///
/// Units    pixels of the projector's picture; `unit`: a hundred and sixtieth of its width.
/// Threads  as Canvas.
#pragma once

#include "app/exhibit/canvas.h"
#include "app/exhibit/text_image.h"
#include "app/pack/words_file.h"

#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace frustumscreen {

/// A reason is half a sentence, as programs say it behind a colon: this makes a whole one.
[[nodiscard]] std::string as_sentence(std::string reason);
/// The first line is the largest.
[[nodiscard]] std::vector<Paragraph> paragraphs_of(const std::vector<std::string>& lines, double unit);

/// What words are broken for at the bake, type sizes: over the table's width, or beside the prop.
inline constexpr double widest_em = 36.0, beside_em = 20.0;
/// The word of that key, set in the house's language; empty where there is none, or where that is English, which the other words are in.
[[nodiscard]] Image<std::uint8_t> house_sentence(const LanguageWords* house, std::string_view key,
                                                 double width_px, double width_em = widest_em);
/// One picture of two, from their left edges.
[[nodiscard]] Image<std::uint8_t> above(const Image<std::uint8_t>& upper, const Image<std::uint8_t>& lower,
                                        double between_px);

/// On a dark ground.
struct TableColours {
    static constexpr Colour white{255, 255, 255};
    static constexpr Colour dim{150, 150, 150};
    static constexpr Colour front{255, 184, 92}; ///< where the prop's front or corner is, and what is amiss
    static constexpr Colour good{120, 240, 120};
    static constexpr Colour bad{255, 110, 90};
};

struct DotColours {
    Colour done, open;
};
/// A row of `count` dots about `middle`; those that are done are thick.
void draw_dots(Canvas& canvas, const glm::dvec2& middle, double unit, int count,
               const std::function<bool(int)>& is_done, const DotColours& colours);

} // namespace frustumscreen
