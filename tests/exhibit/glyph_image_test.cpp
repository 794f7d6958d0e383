// Pictures of glyph runs, with a letter of known area: a square of half an em.
#include "app/typography/caption_image.h"
#include "app/typography/captions.h"
#include "app/typography/glyph_image.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numeric>

using namespace frustumscreen;
using namespace frustumscreen::exhibit;

namespace {

constexpr int texels_per_em = 32;
constexpr int spread = 4;
constexpr int side = 16; ///< of the square, texels

/// The square stands on the baseline, its left edge at the pen. Its distances are exact at the texels' centres.
pack::DistanceAtlas square() {
    constexpr int box = side + 2 * spread;
    pack::DistanceAtlas atlas(box, box);
    for (int y = 0; y < box; ++y) {
        for (int x = 0; x < box; ++x) {
            const double across = std::abs(x + 0.5 - box / 2.0) - side / 2.0;
            const double down = std::abs(y + 0.5 - box / 2.0) - side / 2.0;
            const double outside = std::hypot(std::max(across, 0.0), std::max(down, 0.0));
            const double distance = -(outside > 0.0 ? outside : std::max(across, down));
            atlas.at(x, y) = static_cast<std::uint8_t>(
                std::clamp(pack::outline_code + distance / spread * pack::outline_code, 0.0, 255.0));
        }
    }
    return atlas;
}

/// Squares at these pens, in one line of an em's height whose baseline is 3/4 em below the top.
pack::GlyphSetting line_of(const std::vector<std::int32_t>& pens, std::int32_t width) {
    pack::GlyphSetting setting{width,
                               width,
                               pack::em_units,
                               {{pack::em_units * 3 / 4, static_cast<std::uint32_t>(pens.size())}},
                               {}};
    for (const std::int32_t pen : pens) {
        setting.glyphs.push_back({0, 0, pen});
    }
    return setting;
}

pack::GlyphRuns runs_with(const pack::GlyphSetting& setting) {
    constexpr std::uint16_t box = side + 2 * spread;
    pack::GlyphRuns runs{texels_per_em, spread, box, box, {{0, 0, box, box, -spread, side + spread}}, {}};
    runs.texts = {{"text", pack::TextDirection::LeftToRight, {setting}}};
    return runs;
}

double light(const image::Image<std::uint8_t>& image) {
    return std::accumulate(image.texels.begin(), image.texels.end(), 0.0) / 255.0;
}

} // namespace

TEST(GlyphImage, letter_area_is_right_at_every_size) {
    const pack::GlyphSetting setting = line_of({pack::em_units / 4}, pack::em_units);
    const pack::GlyphRuns runs = runs_with(setting);
    for (const double em_px : {7.0, 11.3, 20.0, 32.0, 60.0, 131.7}) {
        const double area = em_px * em_px / 4.0;
        const typography::GlyphImage image = typography::glyph_image(runs, square(), setting, em_px);
        EXPECT_NEAR(light(image.coverage), area, 0.02 * area) << em_px;
    }
}

TEST(GlyphImage, letter_is_drawn_at_its_pen) {
    const pack::GlyphSetting setting = line_of({pack::em_units / 4}, pack::em_units);
    const typography::GlyphImage image = typography::glyph_image(runs_with(setting), square(), setting, 64.0);
    ASSERT_EQ(image.coverage.width, 64);
    ASSERT_EQ(image.coverage.height, 64);
    // From 16 to 48 across and down.
    EXPECT_EQ(image.coverage.at(32, 32), 255);
    EXPECT_EQ(image.coverage.at(17, 32), 255);
    EXPECT_LT(image.coverage.at(14, 32), 10);
    EXPECT_EQ(image.coverage.at(46, 32), 255);
    EXPECT_LT(image.coverage.at(49, 32), 10);
    EXPECT_EQ(image.coverage.at(32, 17), 255);
    EXPECT_LT(image.coverage.at(32, 14), 10);
    EXPECT_EQ(image.coverage.at(32, 46), 255);
    EXPECT_LT(image.coverage.at(32, 49), 10);
}

TEST(GlyphImage, touching_letters_join_without_a_seam) {
    const pack::GlyphSetting setting = line_of({0, pack::em_units / 2 - 8}, pack::em_units);
    const typography::GlyphImage image = typography::glyph_image(runs_with(setting), square(), setting, 60.0);
    const int row = image.top_px + 30;
    for (int x = 3; x < 56; ++x) {
        EXPECT_EQ(image.coverage.at(image.left_px + x, row), 255) << x;
    }
}

TEST(GlyphImage, letter_beyond_the_edge_is_not_clipped) {
    const pack::GlyphSetting setting = line_of({-pack::em_units / 4}, pack::em_units / 8);
    const typography::GlyphImage image = typography::glyph_image(runs_with(setting), square(), setting, 40.0);
    EXPECT_EQ(image.left_px, 10);
    EXPECT_NEAR(light(image.coverage), 400.0, 8.0);
}

TEST(GlyphImage, blank_text_is_dark_and_oversized_text_is_empty) {
    const pack::GlyphSetting blank{pack::em_units, pack::em_units, pack::em_units, {{pack::em_units, 0}}, {}};
    const typography::GlyphImage image = typography::glyph_image(runs_with(blank), square(), blank, 10.0);
    EXPECT_EQ(image.coverage.width, 10);
    EXPECT_EQ(light(image.coverage), 0.0);
    const pack::GlyphSetting endless = line_of({0}, pack::glyph_limits::max_side);
    EXPECT_TRUE(
        typography::glyph_image(runs_with(endless), square(), endless, 500.0).coverage.texels.empty());
}

TEST(GlyphCaption, title_is_above_text_and_each_is_flush_with_its_direction) {
    const pack::GlyphSetting wide = line_of({0, pack::em_units}, 2 * pack::em_units);
    const pack::GlyphSetting narrow = line_of({0}, pack::em_units / 2);
    pack::GlyphRuns runs = runs_with(wide);
    runs.texts[0].settings.push_back(narrow);
    const pack::GlyphText title{"title", pack::TextDirection::RightToLeft, {narrow}};
    const double em_m = 2.0 * typography::min_caption_em_m;
    const double texels_per_m = 40.0 / em_m;
    const std::array parts{typography::GlyphPart{typography::CaptionRole::Title, &title},
                           typography::GlyphPart{typography::CaptionRole::Text, &runs.texts[0]}};
    const typography::CaptionImage both =
        typography::make_caption(runs, square(), parts, em_m, 0.3, texels_per_m);
    // A title of 1.35 em at the right, above a text of 40 pixels an em, with 0.3 em between them.
    EXPECT_EQ(both.coverage.width, 80);
    EXPECT_EQ(both.coverage.height, 54 + 12 + 40);
    EXPECT_NEAR(both.size_m.x, 80.0 / texels_per_m, 1e-12);
    EXPECT_EQ(both.coverage.at(80 - 14, 27), 255);
    EXPECT_EQ(both.coverage.at(14, 27), 0);
    EXPECT_EQ(both.coverage.at(10, 54 + 12 + 20), 204) << "the text is a little behind the title";
    const typography::CaptionImage less =
        typography::make_caption(runs, square(), std::span(parts).last(1), em_m, 1.5 * em_m, texels_per_m);
    EXPECT_EQ(less.coverage.width, 20) << "the setting that fits";
    const typography::CaptionImage none =
        typography::make_caption(runs, square(), {}, em_m, 0.3, texels_per_m);
    EXPECT_EQ(none.coverage.texels.size(), 1U);
}

TEST(GlyphCaption, small_lines_follow_the_text_and_are_at_least_24_points) {
    pack::GlyphRuns runs = runs_with(line_of({0}, pack::em_units));
    const typography::GlyphPart text{typography::CaptionRole::Text, &runs.texts[0]};
    const typography::GlyphPart small{typography::CaptionRole::Small, &runs.texts[0]};
    const std::array parts{text, small, small};
    for (const double em_pt : {24.0, 28.0, 60.0}) {
        const double em_m = em_pt * 0.0254 / 72.0;
        const double texels_per_m = 50.0 / em_m;
        const double small_px = 50.0 * std::max(0.8 * em_pt, 24.0) / em_pt;
        const typography::CaptionImage image =
            typography::make_caption(runs, square(), parts, em_m, 0.3, texels_per_m);
        // Below it 0.3 em of the text's size, and no gap between the two lines.
        EXPECT_NEAR(image.coverage.height, 50 + 15 + 2 * small_px, 2.0) << em_pt;
        EXPECT_EQ(image.coverage.at(10, 50 + 15 + static_cast<int>(small_px / 2)), 204) << em_pt;
        EXPECT_EQ(image.coverage.at(static_cast<int>(small_px) + 2, image.coverage.height - 10), 0) << em_pt;
        EXPECT_EQ(typography::caption_size_m(runs, parts, em_m, 0.3, texels_per_m), image.size_m);
    }
}
