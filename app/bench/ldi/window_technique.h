/// One way to show a frozen world behind a window, made and timed by `frustumscreen-bench ldi`.
///
/// geometry         the world's triangles again, culled and drawn by the exhibit's plan and renderer; nothing is made.
/// geometry_lod     the same with the coarsest of meshoptimizer's levels that errs by less than half a window pixel.
/// relief_pack      the exhibit's own relief, as the bake makes it, in the directions of a frustum's faces.
/// ours             the depth pixels of a patch that an eye of its cell sees, as points that are warped eight at a time with a depth test
///                  (app/ldi/seen_points.h, point_patch.h).
/// patch_relief     the patch as a block relief (app/ldi/patch_relief.h), drawn as the exhibit draws a relief.
/// patch_relief_2px, _4px  the same with texels of two and four pixels.
/// multi_ldi_paper  the report's: a layered depth image for each patch, splatted in McMillan's order.
/// single_ldi       all 29 cameras in one layered depth image.
/// ibo              an image-based object: layered depth images for the sides of a cube, up to three of which are splatted.
/// cube_depth       a cube of pictures with depth around the window's middle, each drawn by the GPU as a grid of triangles.
/// view_depth       the same of one picture, from where the window was frozen.
/// points           the depth pixels of the patch's layered depth image, drawn by the GPU as points.
///
/// Picture  one sample a pixel, drawn into WindowSet::target, cleared with it; sRGB codes pass unchanged.
/// Frames   window; metres.
/// Threads  that of the set, which must outlive the technique. A technique's own work on the processor uses one core.
/// Errors   a driver without memory.
#pragma once

#include "app/bench/ldi/window_scene.h"
#include "app/image/image.h"
#include "firmware_host/base/result.h"

#include <cstdint>
#include <memory>
#include <string>

namespace frustumscreen::bench {

class WindowTechnique {
public:
    virtual ~WindowTechnique() = default;
    [[nodiscard]] virtual std::string name() const = 0;
    /// Chooses and draws the whole picture; the caller waits until it is drawn.
    virtual void draw(const glm::dvec3& eye_m) = 0;
    /// The point that each pixel of the same picture shows; NaN: none.
    [[nodiscard]] virtual image::ImageFloat hit_points(const glm::dvec3& eye_m) = 0;
    /// Memory that one window needs beside the scene's own data.
    [[nodiscard]] virtual std::uint64_t bytes() const = 0;
    /// Processor time to make all of it.
    [[nodiscard]] virtual double make_ms() const = 0;
};

} // namespace frustumscreen::bench
