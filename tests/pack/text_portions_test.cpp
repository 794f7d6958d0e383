// A description's portions: complete, in order, of whole sentences, and none longer than a caption.
#include "app/pack/text_portions.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

using namespace frustumscreen;
using namespace frustumscreen::pack;

namespace {

/// The text without white space.
std::string letters_of(std::string text) {
    std::erase_if(text, [](char c) { return c == ' ' || c == '\n'; });
    return text;
}

std::string joined(const std::vector<std::string>& portions) {
    return std::accumulate(portions.begin(), portions.end(), std::string());
}

std::size_t letter_count(std::string_view text) {
    return static_cast<std::size_t>(std::count_if(
        text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; }));
}

} // namespace

TEST(TextPortions, joins_short_sentences_and_separates_long_ones) {
    const std::string first = "A slender clay jar stands on a small round foot. Its belly swells.";
    const std::string second =
        "Two handles, each of three reeds side by side, rise from the neck and bend down to "
        "the shoulder, where they end in leaves that somebody has painted red.";
    EXPECT_EQ(portions_of(first + "\n" + second + " So."),
              (std::vector<std::string>{first, second + " So."}));
    EXPECT_TRUE(portions_of("").empty());
    EXPECT_TRUE(portions_of(" \n ").empty());
}

TEST(TextPortions, abbreviation_does_not_end_a_sentence) {
    const std::string sentence =
        "Der Krug ist um 540 v. Chr. in der Werkstatt von Exekias gemacht und im 19. "
        "Jahrhundert nahe der Stadt Vulci in einem Grab der Etrusker gefunden worden.";
    EXPECT_EQ(portions_of(sentence + " Er ist hoch.").front(), sentence + " Er ist hoch.");
    EXPECT_EQ(portions_of(sentence + " " + sentence), (std::vector<std::string>{sentence, sentence}));
}

TEST(TextPortions, a_sentence_that_is_too_long_is_cut_at_a_comma) {
    std::string part = "a jar whose belly is painted with seven warriors and their horses in black";
    const std::string long_one = part + ", " + part + ", " + part + ", " + part;
    const std::vector<std::string> portions = portions_of(long_one);
    ASSERT_EQ(portions.size(), 2U);
    EXPECT_EQ(portions[0], part + ", " + part + ",");
    EXPECT_EQ(portions[1], part + ", " + part);
}

TEST(TextPortions, scripts_without_spaces_are_cut_behind_their_stops) {
    const std::string sentence = "一只细长的陶罐立在小圆足上，罐腹到肩部渐渐鼓起，再收成高高的颈，口沿外翻。";
    const std::vector<std::string> portions =
        portions_of(sentence + sentence + sentence + sentence + sentence);
    ASSERT_EQ(portions.size(), 3U);
    EXPECT_EQ(portions[0], sentence + sentence);
    EXPECT_EQ(portions[2], sentence);
}

/// No text is lost by the cuts, and no portion is much longer than a caption.
TEST(TextPortions, keep_the_whole_text_in_any_script) {
    const std::vector<std::string> sentences{"One two three four five six seven. ",
                                             "Was ist das? ",
                                             "Ein »Wort«, das niemand kennt; ",
                                             "جرة نحيلة من الطين تقف على قدم صغيرة مستديرة، ",
                                             "ينتفخ بطنها حتى الكتف؟ ",
                                             "細い壺が小さな足の上に立ち、",
                                             "二つの取っ手がある。",
                                             "एक पतला घड़ा खड़ा है। ",
                                             "Ένα λυγερό αγγείο· ",
                                             "\n"};
    unsigned seed = 1;
    for (int k = 0; k < 500; ++k) {
        std::string text;
        for (int n = 0; n < 3 + k % 40; ++n) {
            seed = seed * 1664525U + 1013904223U;
            text += sentences[(seed >> 20U) % sentences.size()];
        }
        const std::vector<std::string> portions = portions_of(text);
        ASSERT_EQ(letters_of(joined(portions)), letters_of(text));
        for (const std::string& portion : portions) {
            ASSERT_LE(letter_count(portion), 220U) << portion;
            ASSERT_NE(portion.front(), ' ');
            ASSERT_NE(portion.back(), ' ');
        }
    }
}

TEST(TextPortions, reading_time_depends_on_the_script) {
    EXPECT_NEAR(reading_time_s(std::string(150, 'a')), 10.0, 1e-9);
    EXPECT_NEAR(reading_time_s("一只陶罐立。"), 6.0 / 5.0, 1e-9);
    EXPECT_NEAR(reading_time_s("جرة"), 3.0 / 15.0, 1e-9);
}
