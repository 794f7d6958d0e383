/// Words on the table during a calibration, by touch or by a camera: how they are set, in English and in the house's language, and the
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

/// The word of that key, set in the house's language; empty where there is none, or where that is English, which the other words are in.
[[nodiscard]] Image<std::uint8_t> house_sentence(const LanguageWords* house, std::string_view key,
                                                 double width_px);
/// One picture of two, from their left edges.
[[nodiscard]] Image<std::uint8_t> above(const Image<std::uint8_t>& upper, const Image<std::uint8_t>& lower,
                                        double between_px);

struct DotColours {
    Colour done, open;
};
/// A row of `count` dots about `middle`; those that are done are thick.
void draw_dots(Canvas& canvas, const glm::dvec2& middle, double unit, int count,
               const std::function<bool(int)>& is_done, const DotColours& colours);

} // namespace frustumscreen
