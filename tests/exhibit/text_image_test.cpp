#include "app/typography/text_image.h"

#include <gtest/gtest.h>

#include <numeric>

namespace frustumscreen::exhibit {
namespace {

long ink(const image::Image<std::uint8_t>& image) {
    return std::accumulate(image.texels.begin(), image.texels.end(), 0L);
}

class Text : public testing::Test {
protected:
    void SetUp() override {
        Result<typography::Typesetter> opened = typography::Typesetter::open();
        ASSERT_TRUE(opened) << opened.error().message;
        typesetter.emplace(std::move(*opened));
    }
    std::optional<typography::Typesetter> typesetter;
};

TEST_F(Text, LineGrowsWithItsLettersAndItsSize) {
    const image::Image<std::uint8_t> one = typesetter->line("n", 40.0);
    const image::Image<std::uint8_t> three = typesetter->line("nnn", 40.0);
    EXPECT_NEAR(three.width - one.width, 2.0 * 0.634 * 40.0, 2.0); // an n is 0.634 em wide
    EXPECT_NEAR(static_cast<double>(ink(three)), 3.0 * static_cast<double>(ink(one)),
                0.03 * static_cast<double>(ink(three)));
    EXPECT_NEAR(static_cast<double>(ink(typesetter->line("n", 80.0))), 4.0 * static_cast<double>(ink(one)),
                0.05 * 4.0 * static_cast<double>(ink(one)));
}

TEST_F(Text, LettersOfSeveralScriptsAreNotTheMissingGlyph) {
    const image::Image<std::uint8_t> missing = typesetter->line("\U0010FFFD", 40.0);
    for (const char* letter : {"\u00e9", "\u0416", "\u03a9", "\u0141", "\u1eb7"}) {
        EXPECT_NE(typesetter->line(letter, 40.0).texels, missing.texels) << letter;
        EXPECT_GT(ink(typesetter->line(letter, 40.0)), 0);
    }
}

TEST_F(Text, InvalidUtf8ShowsReplacementCharacters) {
    const image::Image<std::uint8_t> replacement = typesetter->line("\uFFFD", 30.0);
    EXPECT_EQ(typesetter->line("\xFF", 30.0).texels, replacement.texels);
    EXPECT_EQ(typesetter->line("\xC3", 30.0).texels, replacement.texels);
    EXPECT_EQ(typesetter->line("\xED\xA0\x80", 30.0).width,
              typesetter->line("\uFFFD\uFFFD\uFFFD", 30.0).width);
    EXPECT_GT(typesetter->line("\xF0\x9F", 30.0).width, 0);
}

TEST_F(Text, LinesAreBrokenAtSpacesWithinTheWidth) {
    const typography::Paragraph words{"alpha beta gamma delta epsilon zeta", 20.0};
    const image::Image<std::uint8_t> image = typesetter->set(std::span(&words, 1), 120.0);
    EXPECT_LE(image.width, 124);
    const image::Image<std::uint8_t> flat = typesetter->set(std::span(&words, 1), 1e9);
    EXPECT_GT(image.height, 2 * flat.height);
    // No letter is missing.
    EXPECT_NEAR(static_cast<double>(ink(image)), static_cast<double>(ink(flat)),
                0.02 * static_cast<double>(ink(flat)));
}

TEST_F(Text, BreaksLongWordsAndAtLineBreaks) {
    const typography::Paragraph word{"Donaudampfschifffahrtsgesellschaft", 20.0};
    EXPECT_LE(typesetter->set(std::span(&word, 1), 100.0).width, 104);
    const typography::Paragraph two{"a\nb", 20.0};
    const typography::Paragraph one{"a b", 20.0};
    EXPECT_GT(typesetter->set(std::span(&two, 1), 1000.0).height,
              typesetter->set(std::span(&one, 1), 1000.0).height);
    const typography::Paragraph thin{"abc", 20.0};
    EXPECT_GT(typesetter->set(std::span(&thin, 1), 1.0).height, 60); // one letter a line, and it terminates
}

TEST_F(Text, EmptyTextIsAnEmptyPicture) {
    EXPECT_EQ(typesetter->set({}, 100.0).width, 1);
    EXPECT_EQ(ink(typesetter->line("", 20.0)), 0);
}

TEST(TextFiles, ReportsAMissingTypefaceInOneLine) {
    const Result<typography::Typesetter> typesetter = typography::Typesetter::open("/nonexistent");
    ASSERT_FALSE(typesetter);
    EXPECT_EQ(typesetter.error().id, "typeface.missing") << typesetter.error().message;
    EXPECT_EQ(typesetter.error().message.find('\n'), std::string::npos);
}

} // namespace
} // namespace frustumscreen::exhibit
