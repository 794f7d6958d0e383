#include "app/geometry/pinhole.h"
#include "tests/geometry/random_geometry.h"

#include <gtest/gtest.h>

namespace frustumscreen::geometry {
namespace {

Pinhole random_pinhole(Random& random) {
    const int width = static_cast<int>(random.between(16, 4000));
    const int height = static_cast<int>(random.between(16, 4000));
    return {width,
            height,
            random.between(100, 5000),
            random.between(100, 5000),
            random.between(-0.5, 1.5) * width,
            random.between(-0.5, 1.5) * height};
}

TEST(Pinhole, ProjectsAsTheConventionSays) {
    Random random(11);
    for (int k = 0; k < 2000; ++k) {
        const Pinhole p = random_pinhole(random);
        const glm::dvec3 x(random.between(-5, 5), random.between(-5, 5), random.between(0.01, 10));
        const auto pixel = p.pixel(x);
        ASSERT_TRUE(pixel);
        EXPECT_NEAR(pixel->x, p.fx * x.x / x.z + p.cx, 1e-9 * std::abs(pixel->x) + 1e-9);
        EXPECT_NEAR(pixel->y, p.fy * x.y / x.z + p.cy, 1e-9 * std::abs(pixel->y) + 1e-9);
    }
}

TEST(Pinhole, APointAtOrBehindTheLensHasNoPixel) {
    const Pinhole p{1280, 800, 1920, 1920, 640, 400};
    EXPECT_FALSE(p.pixel({0, 0, 0}));
    EXPECT_FALSE(p.pixel({0.1, 0, -1}));
    EXPECT_FALSE(p.pixel({0, 0, std::nan("")}));
}

TEST(Pinhole, PixelToRayRoundTrip) {
    Random random(12);
    for (int k = 0; k < 2000; ++k) {
        const Pinhole p = random_pinhole(random);
        const glm::dvec2 pixel(random.between(0, p.width), random.between(0, p.height));
        const auto back = p.pixel(p.ray(pixel) * random.scale(1e-3, 1e3));
        ASSERT_TRUE(back);
        EXPECT_LT(glm::distance(*back, pixel), 1e-8);
        EXPECT_EQ(p.ray(pixel).z, 1.0);
    }
}

TEST(Pinhole, ClipCoordinatesSpanThePictureWithTheTopAtMinusOne) {
    Random random(13);
    for (int k = 0; k < 2000; ++k) {
        const Pinhole p = random_pinhole(random);
        const glm::dvec2 pixel(random.between(0, p.width), random.between(0, p.height));
        const double depth = random.scale(1e-3, 1e3);
        const glm::dvec4 clip = p.clip_from_point() * glm::dvec4(p.ray(pixel) * depth, 1.0);
        EXPECT_NEAR(clip.w, depth, 1e-12 * depth);
        EXPECT_EQ(clip.z, 0.0);
        EXPECT_NEAR((clip.x / clip.w + 1) / 2 * p.width, pixel.x, 1e-8);
        EXPECT_NEAR((clip.y / clip.w + 1) / 2 * p.height, pixel.y, 1e-8);
    }
}

TEST(Pinhole, AnotherPictureSizeKeepsTheView) {
    const Pinhole p{1280, 800, 1920, 1900, 700, 300};
    const Pinhole half = p.scaled_to(640, 400);
    const glm::dvec3 x(0.2, -0.1, 1.3);
    EXPECT_EQ(half.width, 640);
    EXPECT_EQ(half.height, 400);
    EXPECT_LT(glm::distance(*half.pixel(x) * 2.0, *p.pixel(x)), 1e-10);
}

} // namespace
} // namespace frustumscreen::geometry
