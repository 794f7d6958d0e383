// The words for visitors, language by language, compared with pictures of words.toml by Pango and FreeType.
#include "app/image/image.h"
#include "app/safe/draw_safe_page.h"
#include "assets_baked/texts/builtin_words.h"
#include "assets_baked/texts/fonts.h"
#include "tests/folders.h"

#include <gtest/gtest.h>
#include <pango/pangoft2.h>
#include <toml++/toml.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <set>
#include <string>

namespace frustumscreen::safe {
namespace {

struct Ink {
    int left = 1 << 20, top = 1 << 20, right = 0, bottom = 0;
};

/// The lit pixels, and the smallest box around them.
struct Coverage {
    int width = 0, height = 0;
    std::vector<float> share;
    [[nodiscard]] float at(int x, int y) const {
        return x < 0 || y < 0 || x >= width || y >= height
                   ? 0.0F
                   : share[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                           static_cast<std::size_t>(x)];
    }
    [[nodiscard]] Ink ink() const {
        Ink ink;
        for (int y = 0; y < height; ++y) {
            for (int x = 0; x < width; ++x) {
                if (at(x, y) > 0.5F) {
                    ink = {std::min(ink.left, x), std::min(ink.top, y), std::max(ink.right, x + 1),
                           std::max(ink.bottom, y + 1)};
                }
            }
        }
        return ink;
    }
};

struct Unref {
    void operator()(void* object) const { g_object_unref(object); }
};

Coverage drawn_by_pango(const std::string& text, const std::string& language, const texts::Fonts& fonts,
                        double em_px) {
    const std::unique_ptr<PangoFontMap, Unref> map(pango_ft2_font_map_new());
    pango_fc_font_map_set_config(PANGO_FC_FONT_MAP(map.get()), fonts.config());
    const std::unique_ptr<PangoContext, Unref> context(pango_font_map_create_context(map.get()));
    pango_context_set_round_glyph_positions(context.get(), FALSE);
    pango_context_set_language(context.get(), pango_language_from_string(language.c_str()));
    PangoFontDescription* font = pango_font_description_new();
    pango_font_description_set_family(font, fonts.families_for(language).c_str());
    pango_font_description_set_absolute_size(font, em_px * PANGO_SCALE);
    const std::unique_ptr<PangoLayout, Unref> layout(
        pango_layout_new(context.get())); // detects the direction itself
    pango_layout_set_font_description(layout.get(), font);
    pango_font_description_free(font);
    pango_layout_set_text(layout.get(), text.c_str(), -1);
    Coverage coverage{1600, 200, std::vector<float>(std::size_t{1600} * 200)};
    std::vector<unsigned char> bytes(coverage.share.size());
    FT_Bitmap bitmap{};
    bitmap.rows = 200;
    bitmap.width = 1600;
    bitmap.pitch = 1600;
    bitmap.buffer = bytes.data();
    bitmap.num_grays = 256;
    bitmap.pixel_mode = FT_PIXEL_MODE_GRAY;
    pango_ft2_render_layout(&bitmap, layout.get(), 40, 40);
    std::transform(bytes.begin(), bytes.end(), coverage.share.begin(),
                   [](unsigned char byte) { return static_cast<float>(byte) / 255.0F; });
    return coverage;
}

/// Draws only the visitors' line of the language.
Coverage drawn_by_us(const std::string& language, double& em_px) {
    SafePage page = lay_out_safe_page(1600, 1000, {"x", {}}, {language});
    const float largest = page.letters.front().em_px;
    std::erase_if(page.letters, [&](const PlacedLetter& letter) { return letter.em_px < largest; });
    em_px = largest;
    std::vector<std::uint8_t> greys(std::size_t{1600} * 1000);
    draw_safe_rows(page, 0, greys);
    Coverage coverage{1600, 1000, std::vector<float>(greys.size())};
    const double full = image::linear_from_srgb(page.letters.front().grey / 255.0);
    std::transform(greys.begin(), greys.end(), coverage.share.begin(), [&](std::uint8_t grey) {
        return static_cast<float>(image::linear_from_srgb(grey / 255.0) / full);
    });
    return coverage;
}

/// Correlation of the two inks, with one box moved by (x, y) relative to the other; 1: equal.
double correlation(const Coverage& a, const Ink& from, const Coverage& b, const Ink& to, int x, int y) {
    double both = 0.0;
    double squares_a = 0.0;
    double squares_b = 0.0;
    for (int row = -2; row < from.bottom - from.top + 2; ++row) {
        for (int column = -2; column < from.right - from.left + 2; ++column) {
            const double one = a.at(from.left + column, from.top + row);
            const double other = b.at(to.left + column + x, to.top + row + y);
            both += one * other;
            squares_a += one * one;
            squares_b += other * other;
        }
    }
    return both / std::sqrt(squares_a * squares_b);
}

double best_correlation(const Coverage& a, const Coverage& b) {
    double best = 0.0;
    for (int y = -1; y <= 1; ++y) {
        for (int x = -1; x <= 1; ++x) {
            best = std::max(best, correlation(a, a.ink(), b, b.ink(), x, y));
        }
    }
    return best;
}

TEST(SafeWords, HaveTheLanguagesOfTheExhibit) {
    std::set<std::string_view> exhibit;
    for (const texts::BuiltinWords& words : texts::builtin_words()) {
        exhibit.insert(words.language);
    }
    const std::vector<std::string_view> names = safe_languages();
    EXPECT_EQ(std::set<std::string_view>(names.begin(), names.end()), exhibit);
    EXPECT_EQ(names.size(), exhibit.size()) << "one is there twice";
}

TEST(SafeWords, MatchPangosDrawing) {
    const toml::table words = toml::parse_file(source_dir() + "/assets_baked/safe/words.toml");
    const Result<texts::Fonts> fonts = texts::Fonts::open();
    ASSERT_TRUE(fonts) << fonts.error().message;
    int languages = 0;
    for (const auto& [key, table] : words) {
        const std::string language(key.str());
        double em_px = 0.0;
        const Coverage ours = drawn_by_us(language, em_px);
        const Coverage meant =
            drawn_by_pango((*table.as_table())["visitors"].value_or(""), language, *fonts, em_px);
        const Ink a = ours.ink();
        const Ink b = meant.ink();
        EXPECT_NEAR(a.right - a.left, b.right - b.left, 2) << language;
        EXPECT_NEAR(a.bottom - a.top, b.bottom - b.top, 2) << language;
        EXPECT_NEAR(a.left, 1600 - a.right, 2) << language << " is in the middle";
        // Pango places each letter on a whole pixel; the program does not.
        EXPECT_GT(best_correlation(ours, meant), 0.9) << language;
        ++languages;
    }
    EXPECT_EQ(languages, 11);
}

/// The measure distinguishes another order of letters, and another text.
TEST(SafeWords, ComparisonDetectsMirroredWords) {
    double em_px = 0.0;
    const Coverage hebrew = drawn_by_us("he", em_px);
    Coverage mirrored = hebrew;
    for (int y = 0; y < hebrew.height; ++y) {
        for (int x = 0; x < hebrew.width; ++x) {
            mirrored.share[static_cast<std::size_t>(y) * 1600 + static_cast<std::size_t>(x)] =
                hebrew.at(1599 - x, y);
        }
    }
    EXPECT_LT(best_correlation(hebrew, mirrored), 0.8);
    EXPECT_GT(best_correlation(hebrew, hebrew), 0.999);
}

} // namespace
} // namespace frustumscreen::safe
