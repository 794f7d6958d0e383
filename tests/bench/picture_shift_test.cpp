// Discs and stripes with exactly known positions: their coverage is computed for each position.

#include "app/bench/measures/picture_shift.h"

#include <gtest/gtest.h>

namespace frustumscreen::bench {
namespace {

constexpr int size = 48;

/// A picture from 256 points per pixel tested with `inside`.
template <typename Inside> image::Image8 picture_of(const Inside& inside, double brightness = 1.0) {
    image::Image8 picture(size, size, glm::u8vec4(0, 0, 0, 255));
    for (int y = 0; y < size; ++y) {
        for (int x = 0; x < size; ++x) {
            int covered = 0;
            for (int k = 0; k < 256; ++k) {
                covered += inside(x + (k % 16 + 0.5) / 16.0, y + (k / 16 + 0.5) / 16.0)
                               ? 1
                               : 0; // NOLINT(bugprone-integer-division)
            }
            const std::uint8_t code = image::srgb8_from_linear(brightness * covered / 256.0);
            picture.at(x, y) = {code, code, code, 255};
        }
    }
    return picture;
}

image::Image8 disc(const glm::dvec2& centre, double brightness = 1.0) {
    return picture_of([&](double x, double y) { return glm::distance(glm::dvec2(x, y), centre) < 15.0; },
                      brightness);
}

constexpr glm::dvec2 middle(23.7, 24.2);

TEST(PictureShift, IsZeroForTheSamePicture) {
    const std::optional<glm::dvec2> shift = picture_shift(disc(middle), disc(middle));
    ASSERT_TRUE(shift);
    EXPECT_EQ(glm::length(*shift), 0.0);
}

/// An edge is steeper within its pixel than the difference of two pixels suggests, so the shift is up to a
/// fifth too large.
TEST(PictureShift, IsMeasuredWithinAHundredthOfAPixelPlusAFifth) {
    for (const glm::dvec2 moved : {glm::dvec2(0.02, 0.0), glm::dvec2(-0.05, 0.05), glm::dvec2(0.0, 0.2),
                                   glm::dvec2(0.5, 0.0), glm::dvec2(-0.5, 0.5)}) {
        const std::optional<glm::dvec2> shift = picture_shift(disc(middle), disc(middle + moved));
        ASSERT_TRUE(shift);
        EXPECT_LT(glm::distance(*shift, moved), 0.01 + 0.22 * glm::length(moved))
            << moved.x << ' ' << moved.y;
        EXPECT_GT(glm::length(*shift), 0.9 * glm::length(moved)) << moved.x << ' ' << moved.y;
    }
}

TEST(PictureShift, IgnoresDarkerOrLargerPictures) {
    std::optional<glm::dvec2> shift = picture_shift(disc(middle), disc(middle, 0.8));
    ASSERT_TRUE(shift);
    EXPECT_LT(glm::length(*shift), 0.01);
    const image::Image8 larger =
        picture_of([](double x, double y) { return glm::distance(glm::dvec2(x, y), middle) < 15.4; });
    shift = picture_shift(disc(middle), larger);
    ASSERT_TRUE(shift);
    EXPECT_LT(glm::length(*shift), 0.01);
}

TEST(PictureShift, IsUndefinedWithoutEdgesInBothDirections) {
    const image::Image8 black(size, size, glm::u8vec4(0, 0, 0, 255));
    EXPECT_FALSE(picture_shift(black, black));
    const image::Image8 stripe = picture_of([](double x, double) { return x > 10.0 && x < 20.5; });
    EXPECT_FALSE(picture_shift(stripe, stripe)); // it may have moved along its direction
}

} // namespace
} // namespace frustumscreen::bench
