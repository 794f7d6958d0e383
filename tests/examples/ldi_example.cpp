// The cameras of the patch that holds the eye draw the window's world. Their pictures become one layered depth image, which is drawn for
// any eye of the patch without the world.
#include "app/ldi/patch_layers.h"
#include "app/ldi/triangle_rasterizer.h"

#include <gtest/gtest.h>

namespace frustumscreen::example {
namespace {

TEST(RoomExample, Ldi) {
    // example
    ldi::TriangleWorld world; // a white triangle, 10 cm behind the window
    world.positions = {{-1.0F, -1.0F, -0.1F}, {1.0F, -1.0F, -0.1F}, {0.0F, 1.0F, -0.1F}};
    world.indices = {0, 1, 2};
    const ldi::CameraView view{.half_extent_m = {0.1, 0.1}, .width = 64, .height = 64};
    const ldi::Hemisphere hemisphere(0.5); // the eye was 50 cm away when the window was frozen
    const glm::dvec3 eye(0.0, -0.3, 0.4);
    const std::size_t patch = hemisphere.patch_of(eye).value(); // 7: in front
    std::array<ldi::DepthPicture, ldi::camera_count> pictures;
    ldi::TriangleRasterizer rasterizer;
    for (const std::size_t camera : hemisphere.cameras_of(patch)) {
        pictures[camera].begin(ldi::camera_at(view, hemisphere.cameras()[camera]));
        rasterizer.draw(world, pictures[camera]);
    }
    const ldi::LayeredDepth layers = ldi::patch_layers(hemisphere, patch, pictures, view);
    ldi::DepthPicture picture;
    picture.begin(ldi::camera_through_window(eye, view.half_extent_m, 64, 64));
    ldi::splat(layers, picture);
    EXPECT_EQ(picture.colours[picture.at(32, 32)], glm::u8vec4(255));
    EXPECT_NEAR(picture.nearness[picture.at(32, 32)], 0.4 / 0.5,
                1e-5); // 0.4 m to the window, 0.5 m to the triangle
    // end
}

} // namespace
} // namespace frustumscreen::example
