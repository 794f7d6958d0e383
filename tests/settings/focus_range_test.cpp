// The sharp depths against the lens's own circle and a search, the lit ones against angles.

#include "app/settings/focus_range.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace frustumscreen::settings {
namespace {

/// The circle that a point at `depth` gets, less the pixel there, both in metres: the ray from the lens's rim crosses
/// the axis at the focus.
double circle_less_pixel(const ProjectorSettings& projector, double focus, double depth) {
    const double half_opening = 0.5e-3 * projector.aperture_mm;
    const double rim_at_depth = half_opening + (0.0 - half_opening) * (depth / focus);
    return 2.0 * std::abs(rim_at_depth) - depth / projector.pinhole.fx;
}

/// Where circle and pixel are equal between two depths, by halving.
double equal_between(const ProjectorSettings& projector, double focus, double sharp, double blurred) {
    for (int k = 0; k < 200; ++k) {
        const double middle = 0.5 * (sharp + blurred);
        (circle_less_pixel(projector, focus, middle) < 0.0 ? sharp : blurred) = middle;
    }
    return sharp;
}

TEST(FocusRange, IsSharpWhereTheCircleIsSmallerThanAPixel) {
    std::mt19937_64 random(57);
    std::uniform_real_distribution<double> aperture(0.1, 60.0), length(500.0, 5000.0), focused(0.3, 3.0);
    int endless = 0;
    for (int k = 0; k < 1000; ++k) {
        ProjectorSettings projector;
        projector.aperture_mm = aperture(random);
        projector.pinhole.fx = projector.pinhole.fy = length(random);
        const double focus = focused(random);
        const DepthRange sharp = sharp_depths(projector, focus);
        EXPECT_NEAR(sharp.nearest_m, equal_between(projector, focus, focus, 0.0), 1e-9 * focus);
        if (circle_less_pixel(projector, focus, 1e9) < 0.0) {
            EXPECT_TRUE(std::isinf(sharp.farthest_m));
            ++endless;
        } else {
            EXPECT_NEAR(sharp.farthest_m, equal_between(projector, focus, focus, 1e9),
                        1e-6 * sharp.farthest_m);
        }
        const double depth = focused(random);
        const double pixel = depth / projector.pinhole.fx;
        EXPECT_NEAR(blur_px(projector, focus, depth),
                    circle_less_pixel(projector, focus, depth) / pixel + 1.0, 1e-9);
    }
    EXPECT_GT(endless, 3);
}

TEST(FocusRange, WithTheLargestApertureTheNearEndBlursByAPixel) {
    ProjectorSettings projector;
    const DepthRange range{.nearest_m = 0.36, .farthest_m = 0.9};
    projector.aperture_mm = largest_aperture_mm(projector, range);
    EXPECT_NEAR(circle_less_pixel(projector, 0.63, 0.36), 0.0, 1e-12);
    EXPECT_LT(circle_less_pixel(projector, 0.63, 0.9), 0.0);
}

TEST(FocusRange, OnTheTableItReachesFromTheTableToThePropsTop) {
    const Settings settings; // the lens looks straight down from 1.5 m
    const auto lit = lit_depths(settings);
    ASSERT_TRUE(lit);
    EXPECT_NEAR(lit->nearest_m, 1.5 - settings.prop.height_m, 1e-12);
    EXPECT_NEAR(lit->farthest_m, 1.5, 1e-12);
}

/// A ball in the angle between two opposite edges: its middle lies on the bisector, and its radius is the sine of half
/// the angle.
TEST(FocusRange, InTheHandItReachesUpToWhereABallStillFits) {
    std::mt19937_64 random(58);
    std::uniform_real_distribution<double> shift(-0.2, 0.2);
    for (int k = 0; k < 100; ++k) {
        Settings settings;
        settings.prop.kind = PropKind::Cube;
        settings.prop.base_m = 0.1;
        settings.prop.height_m = 0.1;
        settings.prop.zone = PropZone::Hand;
        geometry::Pinhole& pinhole = settings.projector.pinhole;
        pinhole.cx *= 1.0 + shift(random);
        pinhole.cy *= 1.0 + shift(random);
        const double ball = 0.05 * std::sqrt(3.0);
        const auto depth = [&](double before, double after) {
            const double low = std::atan(before), high = std::atan(after);
            return ball / std::sin(0.5 * (low + high)) * std::cos(0.5 * (high - low));
        };
        const double across = depth(pinhole.cx / pinhole.fx, (pinhole.width - pinhole.cx) / pinhole.fx);
        const double along = depth(pinhole.cy / pinhole.fy, (pinhole.height - pinhole.cy) / pinhole.fy);
        const auto lit = lit_depths(settings);
        ASSERT_TRUE(lit) << k;
        EXPECT_NEAR(lit->nearest_m, std::fmax(across, along) - ball, 1e-9);
        EXPECT_NEAR(lit->farthest_m, 1.5, 1e-9);
    }
}

TEST(FocusRange, APropThatFitsNowhereHasNoDepths) {
    Settings settings;
    settings.prop.zone = PropZone::Hand;
    settings.prop.kind = PropKind::Cube;
    settings.prop.base_m = settings.prop.height_m = 2.0;
    EXPECT_FALSE(lit_depths(settings));
}

} // namespace
} // namespace frustumscreen::settings
