#include "app/settings/polygon.h"

#include <gtest/gtest.h>

namespace frustumscreen::settings {
namespace {

const Polygon square{{0.0, 0.0}, {2.0, 0.0}, {2.0, 2.0}, {0.0, 2.0}};

TEST(Polygon, TheAreaIsPositiveForCornersCounterClockwise) {
    EXPECT_DOUBLE_EQ(area_of(square), 4.0);
    EXPECT_DOUBLE_EQ(area_of({square.rbegin(), square.rend()}), -4.0);
    EXPECT_DOUBLE_EQ(area_of({{1.0, 1.0}, {5.0, 1.0}, {1.0, 4.0}}), 6.0);
    EXPECT_EQ(area_of({}), 0.0);
}

TEST(Polygon, AHalfPlaneClipsThePolygon) {
    const Polygon right = clipped(square, {{1.0, 0.0}, 0.5});
    EXPECT_DOUBLE_EQ(area_of(right), 3.0);
    EXPECT_EQ(clipped(square, {{-1.0, -1.0}, -3.0}).size(), 5U) << "a corner is cut off";
    EXPECT_DOUBLE_EQ(area_of(clipped(square, {{-1.0, -1.0}, -3.0})), 3.5);
    EXPECT_EQ(clipped(square, {{0.0, 1.0}, -1.0}), square) << "it lies wholly inside";
    EXPECT_TRUE(clipped(square, {{0.0, 1.0}, 2.5}).empty());
    EXPECT_TRUE(clipped({}, {{0.0, 1.0}, 0.0}).empty());
}

TEST(Polygon, TheLargestRectangleOfARectangleIsItself) {
    const Rectangle found = rectangle_inside({{1.0, -1.0}, {4.0, -1.0}, {4.0, 0.0}, {1.0, 0.0}});
    EXPECT_NEAR(found.centre_m.x, 2.5, 1e-12);
    EXPECT_NEAR(found.centre_m.y, -0.5, 1e-12);
    EXPECT_NEAR(found.half_m.x, 1.5, 0.01);
    EXPECT_NEAR(found.half_m.y, 0.5, 0.01);
}

TEST(Polygon, TheLargestRectangleOfASquareOnItsCornerIsHalfOfIt) {
    const Rectangle found = rectangle_inside({{1.0, 0.0}, {0.0, 1.0}, {-1.0, 0.0}, {0.0, -1.0}});
    EXPECT_NEAR(found.half_m.x, 0.5, 1e-9);
    EXPECT_NEAR(found.half_m.y, 0.5, 1e-9);
    EXPECT_EQ(rectangle_inside({}).half_m, glm::dvec2(0.0));
}

} // namespace
} // namespace frustumscreen::settings
