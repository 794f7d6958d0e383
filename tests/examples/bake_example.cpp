// A source mesh becomes a pack. Its box stands upright on z = 0, centred, and its longest edge is 1.
#include "assets_baked/bake/bake.h"
#include "tests/bake/shapes.h"

#include <gtest/gtest.h>

namespace frustumscreen::example {
namespace {

TEST(RoomExample, Bake) {
    // example
    bake::SourceMesh ball = test::empty_mesh();
    test::add_sphere(ball, {5.0, 0.0, 0.0}, 3.0, 12);
    bake::BakeOptions options;
    options.up = "z";
    options.relief = false;
    options.measuring = 0.05; // few rays: quick, and rough
    const pack::Pack pack = bake::bake(ball, options).value();
    const glm::dvec3 top(pack.box_from_file * glm::dvec4(5.0, 0.0, 3.0, 1.0)); // of the ball
    EXPECT_NEAR(glm::distance(top, glm::dvec3(0.0, 0.0, 1.0)), 0.0, 1e-9);
    EXPECT_FALSE(pack.levels.empty()); // coarse to fine, each with its measured error
    // end
}

} // namespace
} // namespace frustumscreen::example
