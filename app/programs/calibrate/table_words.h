/// Words on the table during a calibration, by touch, by a camera or by eye: what they are, how they are set, in English and in the house's
/// language, and the dots that count what is done.
///
/// Message  one row has both its key among the exhibit's own words, which are said aloud and written in the house's language, and what stands
///          on the table in English: that is longer, and has figures. Rows of one key say one thing.
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

namespace frustumscreen {

struct Message {
    std::string_view key, english; ///< either may be empty
};
/// What is said for a procedure's word, or for how a thing is to be held.
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

/// What is said at a time.
struct TableWords {
    std::string_view key;           ///< empty: there is none for it
    std::vector<std::string> lines; ///< in English; the first one is the largest
    std::uint64_t of = 0; ///< which point or picture it belongs to: the same words of another one are others
    [[nodiscard]] bool operator==(const TableWords&) const = default;
    /// One more line; its key counts from then on, if it has one.
    void add(std::string_view next_key, std::string_view line);
    void add(const Message& message) { add(message.key, message.english); }
};
[[nodiscard]] TableWords one_moment();
[[nodiscard]] TableWords all_kept();
[[nodiscard]] TableWords all_unchanged();
/// Why it cannot be done has no key: there is none for every reason.
[[nodiscard]] TableWords why_not(std::string_view title, std::string_view reason, std::string_view back);

/// A reason is half a sentence, as programs say it behind a colon: this makes a whole one.
[[nodiscard]] std::string as_sentence(std::string_view reason);
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
