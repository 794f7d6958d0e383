#include "app/typography/canvas.h"
#include "app/typography/pattern.h"

#include <gtest/gtest.h>

namespace frustumscreen::exhibit {
namespace {

typography::PatternScene shipped() {
    return {{1280, 800, 1920.0, 1920.0, 640.0, 400.0},
            {glm::dquat(0.0, 1.0, 0.0, 0.0), {0.0, 0.0, 1.2}},
            {0.8, 0.5},
            geometry::make_frustum({})};
}

TEST(Pattern, OutermostPixelsAreWhiteAndInnerOnesDark) {
    const Result<typography::Typesetter> typesetter = typography::Typesetter::open();
    ASSERT_TRUE(typesetter);
    const image::Image8 picture = typography::table_pattern(shipped(), *typesetter);
    for (int x = 0; x < picture.width; ++x) {
        EXPECT_EQ(picture.at(x, 0).r, 255);
        EXPECT_EQ(picture.at(x, picture.height - 1).r, 255);
    }
    EXPECT_EQ(picture.at(0, 137).r, 255);
    EXPECT_EQ(picture.at(picture.width - 1, 137).r, 255);
    EXPECT_LT(picture.at(picture.width - 5, 137).r, 20);
}

TEST(Pattern, PropEdgesMatchThePinholeProjection) {
    const Result<typography::Typesetter> typesetter = typography::Typesetter::open();
    ASSERT_TRUE(typesetter);
    const typography::PatternScene scene = shipped();
    const image::Image8 black(1280, 800, glm::u8vec4(0, 0, 0, 255));
    const image::Image8 picture =
        typography::with_prop(black, scene, {{1, 0, 0, 0}, {0.1, -0.05, 0.0}}, *typesetter);
    // The base's corner (+x, -y): 1920 / 1.2 = 1600 pixels a metre; the picture's top is +Y.
    const glm::dvec2 corner(640.0 + 1600.0 * 0.18, 400.0 + 1600.0 * 0.13);
    EXPECT_GT(picture.at(static_cast<int>(corner.x) - 20, static_cast<int>(corner.y)).g, 150);
    EXPECT_GT(picture.at(static_cast<int>(corner.x), static_cast<int>(corner.y) - 20).g, 150);
    EXPECT_EQ(picture.at(static_cast<int>(corner.x) + 12, static_cast<int>(corner.y) + 12).g, 0);
}

TEST(Canvas, ScaledDownPictureKeepsItsMeanLight) {
    image::Image8 checks(64, 64, glm::u8vec4(0, 0, 0, 255));
    for (int y = 0; y < 64; ++y) {
        for (int x = 0; x < 64; ++x) {
            checks.at(x, y) = (x + y) % 2 == 0 ? glm::u8vec4(255) : glm::u8vec4(0, 0, 0, 255);
        }
    }
    typography::Canvas canvas(8, 8, typography::Colour(9));
    canvas.picture(checks, {0, 0}, {64, 64}, {0, 0}, {8, 8});
    EXPECT_NEAR(canvas.image().at(4, 4).r, 188, 1); // half the light is code 188
}

TEST(Canvas, FillCoversPartialPixelsByTheirShare) {
    typography::Canvas canvas(4, 4, typography::Colour(0));
    canvas.fill({0.5, 0.0}, {2.0, 4.0}, typography::Colour(255));
    EXPECT_NEAR(canvas.image().at(0, 1).r, 188, 1);
    EXPECT_EQ(canvas.image().at(1, 1).r, 255);
    EXPECT_EQ(canvas.image().at(2, 1).r, 0);
}

TEST(Pattern, StaffLinesStayInThePictureAndWrap) {
    const Result<typography::Typesetter> typesetter = typography::Typesetter::open();
    ASSERT_TRUE(typesetter);
    const image::Image8 black(640, 400, glm::u8vec4(0, 0, 0, 255));
    const auto lit_rows = [&](const std::string& line) {
        const image::Image8 picture =
            typography::with_lines(black, std::vector<std::string>{line}, *typesetter);
        int rows = 0;
        for (int y = 0; y < picture.height; ++y) {
            bool lit = false;
            for (int x = 0; x < picture.width; ++x) {
                lit = lit || picture.at(x, y).r > 100;
                EXPECT_TRUE(picture.at(x, y).r == 0 || (x >= 20 && x < 620));
            }
            rows += lit ? 1 : 0;
        }
        return rows;
    };
    const int one = lit_rows("tracker: running");
    EXPECT_GT(one, 5);
    std::string many = "tracker:";
    for (int k = 0; k < 20; ++k) {
        many += " is running well";
    }
    EXPECT_GT(lit_rows(many), 3 * one);
}

} // namespace
} // namespace frustumscreen::exhibit
