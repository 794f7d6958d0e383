// A caption is placed beside the prop, never in the prop's shadow.
#include "app/typography/captions.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace frustumscreen::example {
namespace {

TEST(RoomExample, Typography) {
    // example
    const std::array<glm::dvec2, 4> table{{{-0.4, -0.25}, {0.4, -0.25}, {0.4, 0.25}, {-0.4, 0.25}}};
    const std::optional<typography::TablePolygon> shadow =
        typography::hidden_by_prop(geometry::make_cube(0.16), {}, {0.0, 0.0, 1.6});
    EXPECT_NEAR(std::abs(shadow->corners()[0].x), 0.08 * 1.6 / (1.6 - 0.16), 1e-12); // of a cube of 0.16 m

    typography::CaptionPlacer placer(table);
    placer.set_shapes(std::array{glm::dvec2(0.2, 0.05)}); // width and height
    placer.update(MonotonicTime{}, shadow, {}, {0.0, 0.0});
    const typography::CaptionPlace place =
        placer.at(MonotonicTime{} + std::chrono::seconds(2)); // has faded in
    EXPECT_EQ(place.opacity, 1.0);
    EXPECT_GT(typography::clearance(shadow->corners(), place.rectangle.corners()), 0.0);
    // end
}

} // namespace
} // namespace frustumscreen::example
