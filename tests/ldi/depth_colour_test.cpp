// Colours of merged depth pixels against those of the surface.
#include "app/ldi/layered_depth.h"
#include "app/ldi/patch_layers.h"
#include "app/ldi/triangle_rasterizer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <utility>

namespace frustumscreen::ldi {
namespace {

/// A slanted plane whose red grows by 8 codes a pixel: a colour that stands half a pixel off is wrong by 4.
TEST(LayerMerger, DepthPixelHasTheColourOfItsPosition) {
    constexpr double half_m = 0.1;
    constexpr int px = 24;
    TriangleWorld plane;
    plane.positions = {{-1.0F, -1.0F, -0.6F}, {1.0F, -1.0F, 0.2F}, {1.0F, 1.0F, 0.2F}, {-1.0F, 1.0F, -0.6F}};
    plane.indices = {0, 1, 2, 0, 2, 3};
    plane.texture_places = {{0.0F, 0.0F}, {1.0F, 0.0F}, {1.0F, 1.0F}, {0.0F, 1.0F}};
    image::Image8 ramp(2048, 1);
    const auto red_at = [](double x_m) {
        return std::clamp(128.0 + 8.0 * px / (2.0 * half_m) * x_m, 0.0, 255.0);
    };
    for (int x = 0; x < ramp.width; ++x) {
        ramp.at(x, 0) = glm::u8vec4(std::lround(red_at((x + 0.5) / 1024.0 - 1.0)), 0, 0, 255);
    }
    plane.texture = std::make_shared<const image::Image8>(std::move(ramp));
    const Hemisphere hemisphere(0.5);
    const CameraView ramp_view{.half_extent_m = glm::dvec2(half_m), .width = px, .height = px};
    std::array<DepthPicture, camera_count> pictures;
    TriangleRasterizer rasterizer;
    for (std::size_t camera = 0; camera < camera_count; ++camera) {
        pictures[camera].begin(camera_at(ramp_view, hemisphere.cameras()[camera]));
        rasterizer.draw(plane, pictures[camera]);
    }
    for (const std::size_t patch : {0, 1, 4}) {
        const LayeredDepth layers = patch_layers(hemisphere, patch, pictures, ramp_view);
        const PictureMap map(layers.camera);
        std::size_t inner = 0;
        std::size_t off = 0;
        for (int y = 3; y + 3 < layers.camera.height; ++y) {
            for (int x = 3; x + 3 < layers.camera.width; ++x) {
                for (const DepthPixel& pixel : layers.at(x, y)) {
                    const double red =
                        red_at(map.point(x + 0.5, y + 0.5, static_cast<double>(pixel.nearness)).x);
                    ++inner;
                    off += std::fabs(red - static_cast<double>(pixel.colour.r)) > 1.5 ? 1 : 0;
                }
            }
        }
        EXPECT_GT(inner, 200U);
        EXPECT_LE(off, inner / 20) << "patch " << patch; // at the border of a camera's picture
    }
}

} // namespace
} // namespace frustumscreen::ldi
