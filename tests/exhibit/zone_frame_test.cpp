#include "app/exhibit/zone_frame.h"

#include <gtest/gtest.h>

#include <cmath>

namespace frustumscreen::exhibit {
namespace {

const settings::Rectangle axis{{0.02, -0.01}, {0.2, 0.05}};
const glm::dvec2 table(0.8, 0.5);
constexpr double half_bottom = 0.15;

geometry::RigidTransform at(double x, double y, double z = 0.0, double tilt = 0.0) {
    return {glm::angleAxis(tilt, glm::dvec3(1, 0, 0)), {x, y, z}};
}

TEST(ZoneFrame, IsDarkWhileThePropIsWellInside) {
    const ZoneFrame frame(axis, half_bottom, table);
    for (const glm::dvec2 side :
         {glm::dvec2(0, 0), glm::dvec2(0.9, 0), glm::dvec2(-0.9, 0.5), glm::dvec2(0, -0.6)}) {
        const glm::dvec2 place = axis.centre_m + side * axis.half_m;
        EXPECT_EQ(frame.share(at(place.x, place.y)), 0.0);
    }
}

TEST(ZoneFrame, IsBrightWhenThePropIsOutsideLiftedOrTilted) {
    const ZoneFrame frame(axis, half_bottom, table);
    EXPECT_EQ(frame.share(at(0.3, 0.0)), 1.0);
    EXPECT_EQ(frame.share(at(0.0, -0.2)), 1.0);
    EXPECT_EQ(frame.share(at(0.02, -0.01, 0.1)), 1.0);
    EXPECT_EQ(frame.share(at(0.02, -0.01, 0.0, 0.6)), 1.0);
    EXPECT_NEAR(frame.share(at(0.22, -0.01)), 0.5, 1e-9) << "half of it on the border";
}

TEST(ZoneFrame, NeverJumps) {
    const ZoneFrame frame(axis, half_bottom, table);
    double before = frame.share(at(0.0, 0.0));
    for (int k = 0; k <= 4000; ++k) {
        const double share = frame.share(at(1e-4 * k, 2e-5 * k, 5e-6 * k, 2e-4 * k));
        EXPECT_LT(std::abs(share - before), 0.01) << k;
        before = share;
    }
}

TEST(ZoneFrame, EnclosesThePropsBaseWithinTheTable) {
    for (const double half : {0.03, 0.15, 0.4}) {
        const ZoneFrame frame(axis, half, table);
        glm::dvec2 low(1e9);
        glm::dvec2 high(-1e9);
        for (const typography::TableRectangle& side : frame.sides()) {
            for (const glm::dvec2& corner : side.corners()) {
                low = glm::min(low, corner);
                high = glm::max(high, corner);
            }
        }
        const glm::dvec2 wanted_low = glm::max(axis.centre_m - axis.half_m - half, -0.5 * table);
        const glm::dvec2 wanted_high = glm::min(axis.centre_m + axis.half_m + half, 0.5 * table);
        EXPECT_LT(glm::distance(low, wanted_low), 1e-12);
        EXPECT_LT(glm::distance(high, wanted_high), 1e-12);
    }
}

TEST(ZoneFrame, IsAbsentWithoutAZone) {
    EXPECT_EQ(ZoneFrame().share(at(1.0, 1.0)), 0.0);
    EXPECT_EQ(ZoneFrame({}, half_bottom, table).share(at(1.0, 1.0)), 0.0);
}

} // namespace
} // namespace frustumscreen::exhibit
