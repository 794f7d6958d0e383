// A relief is rasterized for one eye and one projector. hit_points returns the place of the artifact that
// each pixel shows.
#include "app/relief/relief_painter.h"

#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

#include <cmath>

namespace frustumscreen::example {
namespace {

relief::BlockRelief square_half_way_up() {
    relief::ReliefBlock block;
    block.w0 = 4.0F;
    block.cells = {0, 8, 0, 8};
    block.mask = ~std::uint64_t{0};
    relief::BlockRelief relief;
    relief.texel_box = 0.125F;
    relief.grids = {{{0, 1, 2}, 1.0, {-0.5, -0.5, 0.0}}}; // u along x, v along y, w along z
    relief.first_block = {0, 1};
    relief.blocks = {block};
    relief.corner_codes.assign(64, 0);
    relief.colours.assign(81, glm::u8vec4(255));
    return relief;
}

TEST(RoomExample, Relief) {
    // example
    const relief::BlockRelief relief = square_half_way_up(); // 8 x 8 cells at z = 0.5 of the box
    relief::RasterScene scene;
    scene.prop_from_box = glm::scale(glm::dmat4(1.0), glm::dvec3(0.08)); // the box is 8 cm wide
    scene.projector = {192, 120, 360.0, 360.0, 96.0, 60.0};
    scene.prop_from_projector = {{0.0, 1.0, 0.0, 0.0}, {0.0, 0.0, 1.5}};
    scene.eye_m = {0.0, 0.0, 1.0};
    relief::RasterView view;
    relief::set_up(view, geometry::make_frustum({}), scene);

    std::vector<glm::vec3> points(192 * 120); // of the picture, in the box frame
    relief::ReliefPainter(1).hit_points(relief, view, {points.data(), 192, 120, 192});
    EXPECT_NEAR(points[60 * 192 + 96].z, 0.5F, 1e-5F); // the middle pixel shows the square
    EXPECT_TRUE(std::isnan(points[60 * 192 + 20].z));  // beside the artifact nothing is hit
    // end
}

} // namespace
} // namespace frustumscreen::example
