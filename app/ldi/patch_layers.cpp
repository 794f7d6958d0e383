#include "app/ldi/patch_layers.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace frustumscreen::ldi {

PictureCamera camera_at(const CameraView& view, const glm::dvec3& eye) {
    const auto side = [&](int pixels) {
        return std::clamp(static_cast<int>(std::ceil(view.margin * pixels - 1e-9)), 1, max_picture_side);
    };
    const int width = side(view.width);
    const int height = side(view.height);
    // A whole number of pixels, each as large as the window's.
    return camera_through_window(
        eye, view.half_extent_m * glm::dvec2(width, height) / glm::dvec2(view.width, view.height), width,
        height);
}

LayeredDepth merged(std::span<const DepthPicture* const> pictures, const glm::dvec3& eye,
                    const PixelGrid& grid, double tolerance_steps) {
    LayerMerger merger(camera_around(pictures, eye, grid), tolerance_steps);
    for (const DepthPicture* picture : pictures) {
        merger.add(*picture);
    }
    return merger.take();
}

LayeredDepth patch_layers(const Hemisphere& hemisphere, std::size_t patch,
                          std::span<const DepthPicture, camera_count> pictures, const CameraView& view) {
    std::vector<const DepthPicture*> seeing;
    for (const std::size_t camera : hemisphere.cameras_of(patch)) {
        seeing.push_back(&pictures[camera]);
    }
    const ImagePlane plane = hemisphere.image_plane_of(patch);
    return merged(seeing, hemisphere.radius_m() * hemisphere.middle_of(patch),
                  {glm::dvec3(0.0), plane.right, plane.up, view.pitch_m(), view.max_side},
                  view.tolerance_steps);
}

} // namespace frustumscreen::ldi
