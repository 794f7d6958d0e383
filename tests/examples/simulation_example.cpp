// The visitor's view is computed from a picture of the projector. Here the picture is red on the left and
// blue on the right.
#include "app/settings/settings.h"
#include "app/simulation/visitor_view.h"

#include <gtest/gtest.h>

namespace frustumscreen::example {
namespace {

TEST(RoomExample, Simulation) {
    // example
    const glm::u8vec4 red(255, 0, 0, 255), blue(0, 0, 255, 255);
    image::Image8 projected(192, 120, blue);
    for (int k = 0; k < 192 * 120; ++k) {
        projected.at(k % 192, k / 192) = k % 192 < 96 ? red : blue;
    }
    const settings::ProjectorSettings projector;
    const simulation::VisitorScene scene{projector.pinhole.scaled_to(192, 120),
                                         projector.table_from_projector,
                                         geometry::make_frustum({}),
                                         {},
                                         {0.0, -0.55, 0.50}};
    const simulation::VisitorCamera eye =
        simulation::visitor_camera(scene.prop, scene.table_from_prop, scene.eye_m, 96, 60);
    const image::Image8 view = simulation::visitor_view(scene, projected, eye, simulation::exact_check());
    EXPECT_EQ(view.at(38, 30), red); // the prop's left half
    EXPECT_EQ(view.at(58, 30), blue);
    // end
}

} // namespace
} // namespace frustumscreen::example
