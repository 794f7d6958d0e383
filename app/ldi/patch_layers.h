/// The multi-LDI report's way of keeping a window's world: a layered depth image for each patch of the hemisphere.
///
/// Frames   window (triangle_world.h).
/// Units    metres, pixels.
/// Errors   none: a patch whose cameras see nothing is an image without a pixel.
/// Threads  pure; any.
/// Source   the multi-LDI report, 5.4. It does not say where the image's own eye is, nor how large its picture: the eye is the
///          patch's middle, and the picture holds whatever the patch's cameras see. Its pixels have the size of the
///          cameras' own on the window.
#pragma once

#include "app/ldi/hemisphere.h"
#include "app/ldi/layered_depth.h"
#include "app/ldi/triangle_world.h"

#include <glm/glm.hpp>

#include <cstddef>
#include <span>

namespace frustumscreen::ldi {

/// How the hemisphere's cameras see.
struct CameraView {
    glm::dvec2 half_extent_m{0.1}; ///< of the window; above 0
    int width = 256, height = 256; ///< pixels across the window
    /// The size of the pictures' rectangle, in windows. The report's cameras see through the window alone (1). Then an eye between
    /// two cameras may see a place farther behind the window than the eyes are before it, and neither camera sees it.
    double margin = 1.0;
    int max_side = 1024; ///< of a layered depth image, pixels
    double tolerance_steps = default_tolerance_steps;

    [[nodiscard]] double pitch_m() const { return 2.0 * half_extent_m.x / width; }
};

/// The picture of a camera at `eye`, through the window and its margin.
[[nodiscard]] PictureCamera camera_at(const CameraView& view, const glm::dvec3& eye);

/// Merges pictures of some cameras, the first one's points first, into an image with this eye and plane.
[[nodiscard]] LayeredDepth merged(std::span<const DepthPicture* const> pictures, const glm::dvec3& eye,
                                  const PixelGrid& grid, double tolerance_steps);

/// A patch of the multi-LDI. `pictures`: of the hemisphere's cameras, by number; those of `cameras_of(patch)` are read.
[[nodiscard]] LayeredDepth patch_layers(const Hemisphere& hemisphere, std::size_t patch,
                                        std::span<const DepthPicture, camera_count> pictures,
                                        const CameraView& view);

} // namespace frustumscreen::ldi
