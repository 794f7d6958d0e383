// A pose is named to_from, and a pinhole maps points in front of it to pixels. Here: which pixel of the
// projector lights a place of the table.
#include "app/geometry/pinhole.h"
#include "app/geometry/table_plane.h"
#include "app/geometry/transform.h"

#include <gtest/gtest.h>

namespace frustumscreen::example {
namespace {

TEST(RoomExample, Geometry) {
    // example
    const geometry::Pinhole projector{1920, 1200, 3600.0, 3600.0, 960.0, 600.0};
    const geometry::RigidTransform table_from_projector{{0.0, 1.0, 0.0, 0.0},
                                                        {0.0, 0.0, 1.5}}; // looks straight down
    const geometry::RigidTransform projector_from_table = table_from_projector.inverse();
    const glm::dvec2 pixel = *projector.pixel(projector_from_table.point({0.3, 0.2, 0.0}));
    EXPECT_NEAR(pixel.x, 960.0 + 3600.0 * 0.3 / 1.5, 1e-9);
    EXPECT_NEAR(pixel.y, 600.0 - 3600.0 * 0.2 / 1.5, 1e-9); // the picture's top is the table's far edge

    const glm::dvec2 place = *geometry::lights_table(projector, table_from_projector, pixel); // and back
    EXPECT_NEAR(glm::distance(place, glm::dvec2(0.3, 0.2)), 0.0, 1e-12);
    // end
}

} // namespace
} // namespace frustumscreen::example
