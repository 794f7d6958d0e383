// The layout of the safe picture's words, and the treatment of a reason.
#include "app/safe/draw_safe_page.h"
#include "app/safe/safe_page.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>
#include <string>

namespace frustumscreen::safe {
namespace {

const SafeText usual{"The exhibit ended five times within ten minutes.", std::chrono::minutes(83)};

std::vector<std::uint8_t> drawn(const SafePage& page) {
    std::vector<std::uint8_t> greys(static_cast<std::size_t>(page.width) *
                                    static_cast<std::size_t>(page.height));
    draw_safe_rows(page, 0, greys);
    return greys;
}

struct Size {
    int width, height;
};
constexpr Size sizes[]{{640, 400},   {1024, 768},  {1280, 800}, {1920, 1200}, {3840, 2160},
                       {1080, 1920}, {2160, 3840}, {800, 1280}, {320, 320},   {4096, 1080}};

TEST(SafePage, FitsPicturesOfEverySizeAndKeepsTheMarginBlack) {
    SafeText longest = usual;
    longest.reason = std::string(2000, 'W');
    for (const Size& size : sizes) {
        for (const SafeText& text : {usual, longest}) {
            const SafePage page = lay_out_safe_page(size.width, size.height, text, safe_languages());
            const std::vector<std::uint8_t> greys = drawn(page);
            const int margin = std::min(size.width, size.height) / 25;
            int lit = 0;
            int outside = 0;
            for (int y = 0; y < size.height; ++y) {
                for (int x = 0; x < size.width; ++x) {
                    const bool is_lit =
                        greys[static_cast<std::size_t>(y) * static_cast<std::size_t>(size.width) +
                              static_cast<std::size_t>(x)] != 0;
                    const bool is_inside =
                        x >= margin && y >= margin && x < size.width - margin && y < size.height - margin;
                    lit += is_lit ? 1 : 0;
                    outside += is_lit && !is_inside ? 1 : 0;
                }
            }
            EXPECT_EQ(outside, 0) << size.width << " x " << size.height;
            EXPECT_GT(lit, size.width * size.height / 100) << size.width << " x " << size.height;
        }
    }
}

TEST(SafePage, ContainsTheWordsOfAllLanguagesInEverySize) {
    for (const Size& size : {sizes[0], sizes[4], sizes[5]}) {
        std::size_t alone = 0;
        for (const std::string_view language : safe_languages()) {
            alone += lay_out_safe_page(size.width, size.height, usual, {language}).letters.size();
        }
        const std::size_t together =
            lay_out_safe_page(size.width, size.height, usual, safe_languages()).letters.size();
        EXPECT_GT(together, std::size_t{11} * 15) << "a sentence has at least as many letters";
        EXPECT_LT(together, alone);
    }
    EXPECT_TRUE(lay_out_safe_page(640, 400, usual, {"tlh"}).letters.empty());
}

TEST(SafePage, UsesLargerTypeForVisitorsThanForTheStaff) {
    const SafePage page = lay_out_safe_page(1920, 1200, usual, safe_languages());
    std::set<float> sizes_px;
    for (const PlacedLetter& letter : page.letters) {
        sizes_px.insert(letter.em_px);
    }
    ASSERT_EQ(sizes_px.size(), 2U);
    // On the shipped table 1200 pixels are 0.5 m; 24 points are 8.5 mm.
    EXPECT_GT(*sizes_px.begin() * 500.0F / 1200.0F, 8.5F);
    EXPECT_GT(*sizes_px.rbegin(), *sizes_px.begin());
}

TEST(SafePage, DrawingInBandsGivesTheSamePicture) {
    const SafePage page = lay_out_safe_page(1280, 800, usual, safe_languages());
    const std::vector<std::uint8_t> whole = drawn(page);
    std::vector<std::uint8_t> bands(whole.size());
    for (int y = 0; y < 800; y += 37) {
        const auto rows = static_cast<std::size_t>(std::min(37, 800 - y));
        draw_safe_rows(page, y, std::span(bands).subspan(static_cast<std::size_t>(y) * 1280, rows * 1280));
    }
    EXPECT_EQ(bands, whole);
}

TEST(SafeReason, KeepsTheFirstLineAndReplacesUnknownLetters) {
    EXPECT_EQ(shown_reason("No picture for 120 s."), U"No picture for 120 s.");
    EXPECT_EQ(shown_reason("  two\t lines\r\nand more"), U"two lines");
    EXPECT_EQ(shown_reason("Größe: 5 µm – “naïve” Ő, Ž, €"), U"Größe: 5 µm – “naïve” Ő, Ž, €");
    EXPECT_EQ(shown_reason("a\x01 b\xFF c\xE2\x82"), U"a\uFFFD b\uFFFD c\uFFFD\uFFFD");
    EXPECT_EQ(shown_reason("画\xF0\x9F\x98\x80\xE2\x80\xAE."), U"\uFFFD\uFFFD\uFFFD.")
        << "han, a smiley, an override";
    EXPECT_EQ(shown_reason(""), U"");
    EXPECT_EQ(shown_reason("\nsecond"), U"");
    EXPECT_EQ(shown_reason(std::string(5000, 'x')).size(), longest_reason);
    EXPECT_EQ(shown_reason(std::string(1, '\0')), U"\uFFFD");
}

TEST(SafeReason, BreaksLongReasonsIntoLinesAndTruncatesThem) {
    const auto letters = [](const std::string& reason) {
        return lay_out_safe_page(1280, 800, {reason, {}}, {"en"}).letters;
    };
    const std::size_t without = letters("x").size() - 1;
    EXPECT_EQ(letters(std::string(100, 'n')).size(), without + 100) << "in two lines, and nothing is lost";
    const std::size_t cut = letters(std::string(300, 'W')).size() - without;
    EXPECT_LT(cut, 300U);
    EXPECT_GT(cut, 4U * 30);
    EXPECT_EQ(letters("").size(), letters("No reason was given.").size());
    EXPECT_EQ(letters("\n").size(), letters("").size());
}

TEST(SafeReason, RandomBytesYieldOnlyAvailableLetters) {
    std::mt19937 random(7);
    for (int k = 0; k < 3000; ++k) {
        std::string bytes(random() % 400, ' ');
        for (char& byte : bytes) { // often bytes that begin or continue a character
            byte = static_cast<char>(random() % 3 == 0 ? 0x80 + random() % 0x80 : random() % 256);
        }
        const std::u32string shown = shown_reason(bytes);
        ASSERT_LE(shown.size(), longest_reason);
        ASSERT_EQ(shown.find(U'\n'), std::u32string::npos);
        for (const char32_t character : shown) {
            ASSERT_TRUE(character == U'\uFFFD' || (character >= U' ' && character <= U'\u20AC'))
                << std::hex << +character;
        }
        const std::size_t letters = lay_out_safe_page(320, 320, {bytes, {}}, {"en"}).letters.size();
        ASSERT_GT(letters, 0U);
    }
}

TEST(SafePage, ShowsTheUptime) {
    EXPECT_EQ(in_hours(std::chrono::minutes(0)), "0 min");
    EXPECT_EQ(in_hours(std::chrono::minutes(59)), "59 min");
    EXPECT_EQ(in_hours(std::chrono::minutes(60)), "1 h 0 min");
    EXPECT_EQ(in_hours(std::chrono::hours(240) + std::chrono::minutes(5)), "240 h 5 min");
    EXPECT_NE(drawn(lay_out_safe_page(640, 400, {"x", std::chrono::minutes(1)}, {"en"})),
              drawn(lay_out_safe_page(640, 400, {"x", std::chrono::minutes(2)}, {"en"})));
}

} // namespace
} // namespace frustumscreen::safe
