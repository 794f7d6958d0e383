/// Reliefs rasterized on the processor, as pictures in the GPU's memory, for the draws that name them.
///
/// Lit rectangles without other content are copied into the picture; elsewhere, and in a fade, they are
/// drawn, pixel by pixel, over it. GL state as in FacePass.
///
/// Colour   sRGB codes, in the projector's light (scene/raster_light.h); alpha 0 where no surface was hit.
/// Threads  the render thread, with one thread of its own for each further core. `paint` allocates nothing
///          once it has painted a picture as full, and makes no GL object.
/// Errors   the driver is out of memory.
#pragma once

#include "app/image/image.h"
#include "app/relief/relief_painter.h"
#include "app/render/gpu_store.h"
#include "app/render/shader_cache.h"
#include "app/scene/frame_plan.h"
#include "app/scene/raster_light.h"
#include "firmware_host/base/pixel_rectangle.h"
#include "firmware_host/base/result.h"
#include "firmware_host/gl/gl_handle.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace frustumscreen::render {

class RasterPass {
public:
    /// Allocates `casts` pictures, each as large as the whole picture.
    [[nodiscard]] Result<void> prepare(std::size_t relief_draws, int width, int height);

    /// Rasterizes the plan's reliefs, except those that are not in the store or that the GPU draws.
    void paint(const scene::FramePlan& plan, const GpuStore& store);
    /// Shows the painted reliefs of this plan in the bound framebuffer, whose colour must be a texture;
    /// returns the number of draw calls.
    int show(const scene::FramePlan& plan, const ShaderCache& shaders) const;

    /// Bytes of GPU memory, as the driver reports.
    [[nodiscard]] std::uint64_t bytes() const;

private:
    struct Picture {
        gl::GlTexture texels;                ///< valid in the rectangles that are drawn; the rest is from
                                             ///< earlier frames
        std::vector<PixelRectangle> painted; ///< first the rectangles to copy, then those to draw
        std::size_t copied = 0;
    };
    /// Uploads from main memory into the eye's viewport in the bound texture.
    void upload(std::span<const PixelRectangle> parts, const PixelRectangle& viewport) const;

    std::unique_ptr<relief::ReliefPainter> painter_; ///< null: no picture was prepared
    scene::RasterLight light_;
    image::Image8 memory_; ///< main memory that each relief is rasterized in, one after another
    std::vector<Picture> pictures_;
    gl::GlVertexArray no_attributes_ = gl::GlVertexArray::generate();
};

} // namespace frustumscreen::render
