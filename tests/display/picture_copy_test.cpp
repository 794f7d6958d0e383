#include "firmware_host/base/probe_code.h"
#include "tests/display/copying.h"

#include <GLES3/gl31.h>
#include <gtest/gtest.h>

#include <cmath>

namespace frustumscreen::display {
namespace {

TEST_F(Copying, KeepsEachCodeAndTheTopRowFirstAtTheSameSize) {
    const PictureFramebuffer picture = picture_of(256, 256);
    const std::vector<Texel> screen = copied(picture, {256, 256}, TopRow::First);
    for (int y = 0; y < 256; ++y) {
        for (int x = 0; x < 256; ++x) {
            ASSERT_EQ(screen[static_cast<std::size_t>(256 * y + x)], colour_of(x, y)) << x << ", " << y;
        }
    }
}

TEST_F(Copying, PutsTheTopRowLastInAWindow) {
    const PictureFramebuffer picture = picture_of(64, 40);
    const std::vector<Texel> screen = copied(picture, {64, 40}, TopRow::Last);
    for (int y = 0; y < 40; ++y) {
        for (int x = 0; x < 64; ++x) {
            ASSERT_EQ(screen[static_cast<std::size_t>(64 * y + x)], colour_of(x, 39 - y)) << x << ", " << y;
        }
    }
}

TEST_F(Copying, AddsBlackBarsForAnotherShape) {
    // 64 x 40 in 128 x 100: 128 x 80, ten black rows above and below.
    const PictureFramebuffer picture = picture_of(64, 40, [](int, int) { return Texel{200, 100, 50, 255}; });
    for (const TopRow top : {TopRow::First, TopRow::Last}) {
        const std::vector<Texel> screen = copied(picture, {128, 100}, top);
        for (int y = 0; y < 100; ++y) {
            const bool inside = y >= 10 && y < 90;
            for (int x = 0; x < 128; ++x) {
                const Texel& texel = screen[static_cast<std::size_t>(128 * y + x)];
                if ((top == TopRow::First ? y : 99 - y) == 0 && x < probe_pixels) {
                    continue;
                }
                EXPECT_NEAR(texel[0], inside ? 200 : 0, 1) << x << ", " << y;
                EXPECT_NEAR(texel[1], inside ? 100 : 0, 1);
                EXPECT_NEAR(texel[2], inside ? 50 : 0, 1);
            }
        }
    }
}

TEST_F(Copying, NeverScalesTheProbeCodeInTheCorner) {
    // base/probe_code.h: greys of code 1 and 2. The rest is bright, to make interpolation visible.
    const PictureFramebuffer picture = picture_of(64, 40, [](int x, int y) {
        const auto code = static_cast<unsigned char>(y > 0 || x >= probe_pixels ? 250 : x % 3 == 0 ? 2 : 1);
        return Texel{code, code, code, 255};
    });
    const PixelRectangle away{30, 20, 5, 5};
    const PixelRectangle whole{0, 0, 64, 40};
    // Bars above and below, bars at the sides, no bars, smaller than the picture, and unscaled.
    for (const PixelSize size : {PixelSize{128, 100}, {200, 80}, {128, 80}, {32, 20}, {64, 40}, {5, 30}}) {
        for (const TopRow top : {TopRow::First, TopRow::Last}) {
            for (const PixelRectangle& part : {whole, away}) {
                const std::vector<Texel> screen = copied(picture, size, top, part);
                const int row = top == TopRow::First ? 0 : size.height - 1;
                const bool there = part == whole || !(size == PixelSize{64, 40});
                for (int x = 0; there && x < std::min(probe_pixels, size.width); ++x) {
                    const unsigned char code = x % 3 == 0 ? 2 : 1;
                    EXPECT_EQ(screen[static_cast<std::size_t>(size.width * row + x)],
                              (Texel{code, code, code, 255}))
                        << x << " of " << size.width << " x " << size.height;
                }
            }
        }
    }
    const std::vector<Texel> larger = copied(picture, {128, 80}, TopRow::First);
    EXPECT_GT(larger[2 * probe_pixels + 1][0], 2) << "the picture goes on beside it";
    EXPECT_GT(larger[128][0], 2) << "and below";
}

TEST_F(Copying, CopiesAPartToItsPlaceAndKeepsTheRest) {
    const PictureFramebuffer picture = picture_of(64, 40);
    for (const PixelSize size : {PixelSize{64, 40}, {128, 100}, {50, 30}}) {
        for (const TopRow top : {TopRow::First, TopRow::Last}) {
            const std::vector<Texel> whole = copied(picture, size, top);
            const PixelRectangle part{10, 4, 20, 16};
            const std::vector<Texel> some = copied(picture, size, top, part);
            const PixelRectangle place = letterbox({64, 40}, size);
            const PixelRectangle there = part_on_screen(part, {64, 40}, place);
            const PixelRectangle code{0, 0, size == PixelSize{64, 40} ? 0 : probe_pixels, 1};
            EXPECT_EQ(drawn_, code.empty() ? there : united(there, code));
            int inside = 0;
            for (int row = 0; row < size.height; ++row) {
                const int y = top == TopRow::First ? row : size.height - 1 - row;
                for (int x = 0; x < size.width; ++x) {
                    const auto lies_in = [x, y](const PixelRectangle& area) {
                        return x >= area.x && x < area.x + area.width && y >= area.y &&
                               y < area.y + area.height;
                    };
                    const bool in = lies_in(there);
                    const auto at = static_cast<std::size_t>(size.width * row + x);
                    ASSERT_EQ(some[at], in || lies_in(code) ? whole[at] : (Texel{255, 0, 255, 255}))
                        << x << ", " << y;
                    inside += in ? 1 : 0;
                }
            }
            EXPECT_GE(inside * 64 * 40, 20 * 16 * place.width * place.height);
        }
    }
}

TEST_F(Copying, InterpolatesCodesRatherThanLight) {
    // Black and white columns, at half size. Half the light of white would be code 187.5 (IEC 61966-2-1).
    const PictureFramebuffer picture = picture_of(128, 64, [](int x, int) {
        const auto code = static_cast<unsigned char>(x % 2 == 0 ? 0 : 255);
        return Texel{code, code, code, 255};
    });
    const std::vector<Texel> screen = copied(picture, {64, 32}, TopRow::First);
    for (std::size_t k = probe_pixels; k < screen.size(); ++k) {
        EXPECT_NEAR(screen[k][0], 127.5, 1.0);
    }
}

TEST_F(Copying, CopiesEachOfTwoPicturesIntoItsHalf) {
    const auto upper = [](int x, int y) { return colour_of(x, y); };
    const auto lower = [](int x, int y) { return colour_of(255 - x, 90 + y); };
    const auto both = [](int x, int y) { return y < 40 ? colour_of(x, y) : colour_of(255 - x, 90 + y - 40); };
    const PictureFramebuffer two = picture_of(64, 80, both);
    const PictureFramebuffer first = picture_of(64, 40, upper);
    const PictureFramebuffer second = picture_of(64, 40, lower);
    ASSERT_TRUE(copying_->make_current());
    std::optional<PictureCopy> copy_of_two = PictureCopy::create(2).value();
    ASSERT_TRUE(drawing_->make_current());
    // The same size, bars above and below, bars at the sides, no bars, smaller.
    for (const PixelSize half : {PixelSize{64, 40}, {128, 100}, {200, 80}, {128, 80}, {50, 30}}) {
        const std::size_t count =
            static_cast<std::size_t>(half.width) * static_cast<std::size_t>(half.height);
        const PixelSize target{half.width, 2 * half.height};
        const std::vector<Texel> screen = copied(two, target, TopRow::First, std::nullopt, &*copy_of_two);
        EXPECT_EQ(drawn_, (PixelRectangle{0, 0, target.width, target.height}));
        const std::vector<Texel> above = copied(first, half, TopRow::First);
        const std::vector<Texel> below = copied(second, half, TopRow::First);
        std::size_t different = 0;
        for (std::size_t k = 0; k < count; ++k) {
            const bool code_of_one = half.width != 64 && k < static_cast<std::size_t>(probe_pixels);
            for (std::size_t c = 0; c < 4;
                 ++c) { // the hardware's interpolation counts from each picture's own edge
                different += std::abs(screen[k][c] - above[k][c]) > 1 ? 1 : 0;
                different += !code_of_one && std::abs(screen[count + k][c] - below[k][c]) > 1 ? 1 : 0;
            }
        }
        EXPECT_EQ(different, 0U) << half.width << " x " << half.height;
        const PixelRectangle part{10, 50, 20, 16}; // in the lower half
        const std::vector<Texel> some = copied(two, target, TopRow::First, part, &*copy_of_two);
        const PixelRectangle there = part_on_screen({10, 10, 20, 16}, {64, 40}, letterbox({64, 40}, half));
        for (int y = 0; y < target.height; ++y) {
            for (int x = 0; x < target.width; ++x) {
                const bool in = x >= there.x && x < there.x + there.width && y - half.height >= there.y &&
                                y - half.height < there.y + there.height;
                const bool code = half.width != 64 && y == 0 && x < probe_pixels;
                const auto at = static_cast<std::size_t>(target.width * y + x);
                ASSERT_EQ(some[at], in || code ? screen[at] : (Texel{255, 0, 255, 255})) << x << ", " << y;
            }
        }
    }
    ASSERT_TRUE(copying_->make_current());
    copy_of_two.reset();
    ASSERT_TRUE(drawing_->make_current());
}

TEST_F(Copying, KeepsTheRenderersState) {
    const PictureFramebuffer picture = picture_of(16, 16);
    glBindFramebuffer(GL_FRAMEBUFFER, picture.name());
    glViewport(1, 2, 3, 4);
    glEnable(GL_BLEND);
    glEnable(GL_DEPTH_TEST);
    glBindTexture(GL_TEXTURE_2D, picture.texture());
    copied(picture, {16, 16}, TopRow::First);
    std::array<GLint, 4> viewport{};
    glGetIntegerv(GL_VIEWPORT, viewport.data());
    EXPECT_EQ(viewport, (std::array<GLint, 4>{1, 2, 3, 4}));
    EXPECT_TRUE(glIsEnabled(GL_BLEND) && glIsEnabled(GL_DEPTH_TEST));
    GLint bound = 0;
    glGetIntegerv(GL_FRAMEBUFFER_BINDING, &bound);
    EXPECT_EQ(static_cast<unsigned>(bound), picture.name());
    glGetIntegerv(GL_TEXTURE_BINDING_2D, &bound);
    EXPECT_EQ(static_cast<unsigned>(bound), picture.texture());
}

TEST(Letterbox, IsAsLargeAsItFitsAndCentred) {
    EXPECT_EQ(letterbox({1280, 800}, {1280, 800}), (PixelRectangle{0, 0, 1280, 800}));
    EXPECT_EQ(letterbox({1280, 800}, {1920, 1080}), (PixelRectangle{96, 0, 1728, 1080}));
    EXPECT_EQ(letterbox({1280, 800}, {1024, 768}), (PixelRectangle{0, 64, 1024, 640}));
    EXPECT_EQ(letterbox({8192, 1}, {64, 8192}), (PixelRectangle{0, 4095, 64, 1}));
    for (int width = 1; width < 60; ++width) {
        for (int height = 1; height < 60; ++height) {
            const PixelRectangle place = letterbox({width, height}, {48, 30});
            EXPECT_TRUE(place.width == 48 || place.height == 30);
            EXPECT_TRUE(place.x >= 0 && place.y >= 0 && place.x + place.width <= 48 &&
                        place.y + place.height <= 30);
            EXPECT_LE(std::abs(std::int64_t{place.width} * height - std::int64_t{place.height} * width),
                      std::max(width, height))
                << width << " x " << height;
        }
    }
}

} // namespace
} // namespace frustumscreen::display
