// Titles below pictures: at most two lines, none wider than a place allows; longer ones are cut.

#include "app/typography/captions.h"
#include "app/typography/table_title.h"

#include <gtest/gtest.h>

namespace frustumscreen::exhibit {
namespace {

constexpr double texels_per_m = 2400.0;
constexpr std::uint16_t letter = 0;
constexpr std::uint16_t space = 1;

/// Letters are squares of half the type size, and as far apart.
struct Squares {
    pack::GlyphRuns runs;
    pack::DistanceAtlas atlas{12, 12, 255};

    Squares() {
        runs.texels_per_em = 8;
        runs.spread_texels = 1;
        runs.atlas_width = runs.atlas_height = 12;
        runs.boxes = {{2, 2, 4, 4, 0, 4}, {}};
    }
    /// A title on one line, with a letter wherever `text` has one.
    static pack::GlyphText title(std::string_view text,
                                 pack::TextDirection direction = pack::TextDirection::LeftToRight) {
        pack::GlyphSetting setting;
        setting.limit = 36 * pack::em_units;
        setting.height = pack::em_units;
        for (const char c : text) {
            setting.glyphs.push_back({c == ' ' ? space : letter, 0, setting.width});
            setting.width += pack::em_units;
        }
        setting.lines = {{pack::em_units, static_cast<std::uint32_t>(setting.glyphs.size())}};
        return {"title", direction, {setting}};
    }
};

/// The number of letters in each of the two lines: separate columns of light.
std::array<int, 2> letters_in(const typography::CaptionImage& title) {
    std::array<int, 2> letters{};
    for (int line = 0; line < 2; ++line) {
        bool within = false;
        for (int x = 0; x < title.coverage.width; ++x) {
            bool lit = false;
            const int middle = title.coverage.height > 30 ? title.coverage.height / 2 : title.coverage.height;
            for (int y = line * middle; y < std::min((line + 1) * middle, title.coverage.height); ++y) {
                lit = lit || title.coverage.at(x, y) > 20;
            }
            letters[static_cast<std::size_t>(line)] += lit && !within ? 1 : 0;
            within = lit;
        }
    }
    return letters;
}

TEST(TableTitle, StaysOnOneLineIfItFits) {
    const Squares squares;
    const typography::CaptionImage title =
        typography::make_table_title(squares.runs, squares.atlas, Squares::title("abc de"), texels_per_m);
    EXPECT_NEAR(title.size_m.x, 5.5 * typography::min_caption_em_m, 2.0 / texels_per_m);
    EXPECT_EQ(letters_in(title)[0], 5);
    EXPECT_LE(title.size_m.y, 0.022);
}

TEST(TableTitle, BreaksIntoTwoLinesOfSimilarLength) {
    const Squares squares;
    const typography::CaptionImage title = typography::make_table_title(
        squares.runs, squares.atlas, Squares::title("abc de fghij k"), texels_per_m);
    EXPECT_EQ(letters_in(title), (std::array<int, 2>{5, 6}));
    EXPECT_LE(title.size_m.y, 0.022 + 0.5 / texels_per_m);
    EXPECT_LE(title.size_m.x, typography::table_title_width_m);
    // In right-to-left text the first word is at the right end, so the right part is the first line.
    const typography::CaptionImage arabic = typography::make_table_title(
        squares.runs, squares.atlas, Squares::title("abc de fghij k", pack::TextDirection::RightToLeft),
        texels_per_m);
    EXPECT_EQ(letters_in(arabic), (std::array<int, 2>{6, 5}));
}

TEST(TableTitle, TruncatesWithAFade) {
    const Squares squares;
    for (const pack::TextDirection direction :
         {pack::TextDirection::LeftToRight, pack::TextDirection::RightToLeft}) {
        const typography::CaptionImage title = typography::make_table_title(
            squares.runs, squares.atlas, Squares::title("abcdefghijklmnop", direction), texels_per_m);
        EXPECT_LE(title.size_m.x, typography::table_title_width_m);
        EXPECT_GT(title.size_m.x, typography::table_title_width_m - 2.0 / texels_per_m);
        int first = 0;
        int last = 0;
        for (int y = 0; y < title.coverage.height; ++y) {
            for (int x = 0; x < 10; ++x) {
                first = std::max<int>(first, title.coverage.at(x, y));
                last = std::max<int>(last, title.coverage.at(title.coverage.width - 1 - x, y));
            }
        }
        const bool to_the_left = direction == pack::TextDirection::RightToLeft;
        EXPECT_LT(to_the_left ? first : last, 130);
    }
}

TEST(TableTitle, PlainTextFitsTheWidthAndTwoLines) {
    const Result<typography::Typesetter> typesetter = typography::Typesetter::open();
    ASSERT_TRUE(typesetter) << typesetter.error().message;
    const typography::CaptionImage title = typography::make_table_title(
        *typesetter, "A title of many words that never ends and goes on and on", texels_per_m);
    EXPECT_LE(title.size_m.x, typography::table_title_width_m + 2.0 / texels_per_m);
    EXPECT_LE(title.size_m.y, 0.0225);
}

TEST(TableMarks, AreAnOutlineAndThreeDots) {
    const image::Image<std::uint8_t> square = typography::outlined_square(200);
    const image::Image<std::uint8_t> more = typography::more_mark(200);
    EXPECT_EQ(square.at(100, 100), 0);
    EXPECT_EQ(square.at(100, 3), 255);
    for (const int x : {58, 100, 142}) {
        EXPECT_EQ(more.at(x, 100), 255);
        EXPECT_EQ(square.at(x, 100), 0);
    }
    EXPECT_EQ(more.at(79, 100), 0);
}

} // namespace
} // namespace frustumscreen::exhibit
