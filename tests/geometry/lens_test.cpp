#include "app/geometry/pinhole.h"
#include "tests/geometry/random_geometry.h"

#include <gtest/gtest.h>

#include <cmath>

namespace frustumscreen::geometry {
namespace {

/// The formula of OpenCV's manual, in a different precision and order of sums.
glm::dvec2 by_the_manual(const Lens& lens, const glm::dvec2& x) {
    using Long = long double;
    const Long r2 = static_cast<Long>(x.x) * x.x + static_cast<Long>(x.y) * x.y;
    const Long factor = 1.0L + lens.k1 * r2 + lens.k2 * r2 * r2;
    return {static_cast<double>(x.x * factor), static_cast<double>(x.y * factor)};
}

TEST(Lens, MatchesTheFormulaOfTheOpenCvManual) {
    Random random(21);
    int distorted = 0;
    for (int k = 0; k < 2000; ++k) {
        const Lens lens{random.between(-0.2, 0.2), random.between(-0.05, 0.05)};
        const glm::dvec2 x(random.between(-0.8, 0.8), random.between(-0.5, 0.5));
        if (const auto bent = lens.distort(x)) {
            EXPECT_LT(glm::distance(*bent, by_the_manual(lens, x)), 1e-15);
            ++distorted;
        }
    }
    EXPECT_GT(distorted, 1500);
}

TEST(Lens, UndistortInvertsDistort) {
    Random random(22);
    int came = 0;
    for (int k = 0; k < 5000; ++k) {
        const Lens lens{random.between(-0.4, 0.4), random.between(-0.2, 0.2)};
        const glm::dvec2 x(random.between(-1.0, 1.0), random.between(-1.0, 1.0));
        const auto bent = lens.distort(x);
        if (!bent) {
            continue;
        }
        ++came;
        const auto back = lens.undistort(*bent);
        ASSERT_TRUE(back) << lens.k1 << ' ' << lens.k2 << ' ' << x.x << ' ' << x.y;
        // Near the fold the inverse is as ill-conditioned as the lens is flat.
        const double r2 = glm::dot(x, x);
        const double slope = 1.0 + r2 * (3.0 * lens.k1 + 5.0 * lens.k2 * r2);
        EXPECT_LT(glm::distance(*back, x), 2e-15 / slope);
    }
    EXPECT_GT(came, 4000);
}

TEST(Lens, RejectsPointsBeyondTheFold) {
    // r (1 - 0.1 r^2) increases up to r^2 = 10/3, where its value is 2/3 of sqrt(10/3).
    const Lens lens{-0.1, 0.0};
    EXPECT_NEAR(lens.fold_r2(), 10.0 / 3.0, 1e-14);
    const double fold = std::sqrt(10.0 / 3.0);
    EXPECT_TRUE(lens.distort({0.999 * fold, 0.0}));
    EXPECT_FALSE(lens.distort({1.001 * fold, 0.0}));
    EXPECT_TRUE(lens.undistort({0.0, 0.999 * fold * 2.0 / 3.0}));
    EXPECT_FALSE(lens.undistort({0.0, 1.001 * fold * 2.0 / 3.0}));
    EXPECT_FALSE(lens.undistort({std::nan(""), 0.0}));
    EXPECT_FALSE(lens.distort({std::nan(""), 0.0}));
    EXPECT_TRUE(std::isinf(Lens{}.fold_r2()));
    EXPECT_TRUE(std::isinf((Lens{0.1, 0.0}.fold_r2())));
    EXPECT_TRUE(std::isinf((Lens{-0.1, 0.1}.fold_r2())));
}

TEST(Lens, TheFactorsOfADiscAreWithinTheirBounds) {
    Random random(24);
    for (int k = 0; k < 200; ++k) {
        const Lens lens{random.between(-0.2, 0.2), random.between(-0.2, 0.2)};
        const double r2 = random.between(0.01, 1.0);
        const auto [min_factor, max_factor] = lens.factors_within(r2);
        double seen_min = 1.0;
        double seen_max = 1.0;
        for (int step = 0; step <= 1000; ++step) {
            const double factor = radial_factor(r2 * step / 1000.0, lens.k1, lens.k2);
            seen_min = std::fmin(seen_min, factor);
            seen_max = std::fmax(seen_max, factor);
        }
        EXPECT_NEAR(seen_min, min_factor,
                    1e-6); // error k2 (r2 / 2000)^2 near the turning point, less elsewhere
        EXPECT_NEAR(seen_max, max_factor, 1e-6);
        EXPECT_GE(seen_min, min_factor - 1e-15);
        EXPECT_LE(seen_max, max_factor + 1e-15);
    }
}

TEST(Lens, TheAreaFactorIsTheDeterminantOfDifferences) {
    Random random(25);
    constexpr double h = 1e-5;
    for (int k = 0; k < 200; ++k) {
        const Lens lens{random.between(-0.1, 0.1), random.between(-0.05, 0.05)};
        const glm::dvec2 x(random.between(-0.5, 0.5), random.between(-0.5, 0.5));
        const glm::dvec2 across =
            (by_the_manual(lens, x + glm::dvec2(h, 0)) - by_the_manual(lens, x - glm::dvec2(h, 0))) / (2 * h);
        const glm::dvec2 down =
            (by_the_manual(lens, x + glm::dvec2(0, h)) - by_the_manual(lens, x - glm::dvec2(0, h))) / (2 * h);
        EXPECT_NEAR(across.x * down.y - across.y * down.x, lens.area_factor(glm::dot(x, x)), 1e-9);
    }
}

TEST(Lens, PixelToRayRoundTrip) {
    Random random(23);
    for (int k = 0; k < 2000; ++k) {
        const Pinhole pinhole{1920,
                              1200,
                              1800.0,
                              1810.0,
                              930.0,
                              1150.0,
                              {random.between(-0.1, 0.1), random.between(-0.02, 0.02)}};
        const glm::dvec2 pixel(random.between(0, 1920), random.between(0, 1200));
        const auto back = pinhole.pixel(pinhole.ray(pixel) * random.scale(0.1, 10.0));
        ASSERT_TRUE(back);
        EXPECT_LT(glm::distance(*back, pixel), 1e-11);
        EXPECT_FALSE(pinhole.pixel({0.1, 0.1, -1.0}));
    }
}

TEST(Lens, EqualsThePinholeWithoutDistortion) {
    Pinhole pinhole{1280, 800, 1920.0, 1900.0, 640.0, 400.0, {1e-300, 0.0}};
    const glm::dvec3 point(0.2, -0.1, 1.3);
    EXPECT_EQ(*pinhole.pixel(point), *pinhole.ideal().pixel({point.x / point.z, point.y / point.z, 1.0}));
    EXPECT_EQ(pinhole.ray({100.0, 700.0}), pinhole.ideal().ray({100.0, 700.0}));
}

} // namespace
} // namespace frustumscreen::geometry
