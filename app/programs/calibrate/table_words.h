/// Words on the table during a calibration, by touch, by a camera or by eye: their content and layout, in
/// English and in the house's language, and the dots that count progress.
///
/// Message  A row has a key of the exhibit's own words, which are spoken and written in the house's language,
///          and the English text for the table, which is longer and has figures. Rows with one key mean the
///          same.
/// Units    pixels of the projector's picture; `unit`: a hundred and sixtieth of its width.
/// Threads  as Canvas.
#pragma once

#include "app/pack/words_file.h"
#include "app/typography/canvas.h"
#include "app/typography/text_image.h"

#include <algorithm>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace frustumscreen::programs {

struct Message {
    std::string_view key, english; ///< either may be empty
};
/// The message for a procedure's word, or for a posture.
template <typename Word> struct WordMessage {
    Word word;
    Message message;
};
template <typename Messages, typename Word>
[[nodiscard]] constexpr Message message_of(const Messages& messages, Word word) {
    const auto row =
        std::find_if(messages.begin(), messages.end(), [&](const auto& each) { return each.word == word; });
    return row == messages.end() ? Message() : row->message;
}

/// The words on the table at one time.
struct TableWords {
    std::string_view key;           ///< empty: no key
    std::vector<std::string> lines; ///< in English; the first one is the largest
    std::uint64_t of = 0; ///< number of the point or picture: equal words of another one are different
    [[nodiscard]] bool operator==(const TableWords&) const = default;
    /// Adds a line; its key replaces the key, unless empty.
    void add(std::string_view next_key, std::string_view line);
    void add(const Message& message) { add(message.key, message.english); }
};
[[nodiscard]] TableWords one_moment();
[[nodiscard]] TableWords all_kept();
[[nodiscard]] TableWords all_unchanged();
/// The words on why a calibration cannot be done, without a key.
[[nodiscard]] TableWords why_not(std::string_view title, std::string_view reason, std::string_view back);

/// Makes a sentence of a reason, which is a clause as programs print it after a colon.
[[nodiscard]] std::string as_sentence(std::string_view reason);
/// The first line is the largest.
[[nodiscard]] std::vector<typography::Paragraph> paragraphs_of(const std::vector<std::string>& lines,
                                                               double unit);

/// Widths, in type sizes, for which the bake breaks lines: over the table's width, and beside the prop.
inline constexpr double widest_em = 36.0, beside_em = 20.0;
/// The word of a key, set in the house's language; empty if there is none, or if that language is English,
/// the language of the other words.
[[nodiscard]] image::Image<std::uint8_t> sentence_above(const pack::LanguageWords* own_words,
                                                        std::string_view key, double width_px,
                                                        double width_em = widest_em);
/// Stacks two pictures, aligned at their left edges.
[[nodiscard]] image::Image<std::uint8_t> above(const image::Image<std::uint8_t>& upper,
                                               const image::Image<std::uint8_t>& lower, double between_px);

/// On a dark ground.
struct TableColours {
    static constexpr typography::Colour white{255, 255, 255};
    static constexpr typography::Colour dim{150, 150, 150};
    static constexpr typography::Colour front{255, 184, 92}; ///< the prop's front or corner, and problems
    static constexpr typography::Colour good{120, 240, 120};
    static constexpr typography::Colour bad{255, 110, 90};
};

struct DotColours {
    typography::Colour done, open;
};
/// Draws a row of `count` dots about `middle`; dots that are done are thick.
void draw_dots(typography::Canvas& canvas, const glm::dvec2& middle, double unit, int count,
               const std::function<bool(int)>& is_done, const DotColours& colours);

} // namespace frustumscreen::programs
