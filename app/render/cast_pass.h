/// Reliefs cast on the processor, as pictures in the GPU's memory: what a plan's casts see, for the draws that name them.
///
/// What is lit is copied into the picture where nothing else may stand, and drawn, a pixel for a pixel, over what stands there elsewhere
/// and in a fade. State as FacePass.
///
/// Colour   sRGB codes, in the projector's light (scene/cast_light.h); alpha 0 where nothing was met.
/// Threads  the render thread, with as many more of its own as there are further cores; `paint` allocates nothing once a picture as
///          full was painted, and makes no GL object.
/// Errors   the driver has no memory.
#pragma once

#include "app/image/image.h"
#include "app/relief/relief_painter.h"
#include "app/render/gpu_store.h"
#include "app/render/shader_cache.h"
#include "app/scene/cast_light.h"
#include "app/scene/frame_plan.h"
#include "firmware_host/base/pixel_rectangle.h"
#include "firmware_host/base/result.h"
#include "firmware_host/gl/gl_handle.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace frustumscreen {

class CastPass {
public:
    /// Has room for so many casts a plan, of the whole picture each.
    [[nodiscard]] Result<void> prepare(std::size_t casts, int width, int height);

    /// Casts all of the plan's. Those whose relief is not in the store, and those that the GPU draws, stay out.
    void paint(const FramePlan& plan, const GpuStore& store);
    /// Shows what was painted for this plan in the framebuffer that is bound, whose colour is a texture; returns the number of draw
    /// calls.
    int show(const FramePlan& plan, const ShaderCache& shaders) const;

    /// Bytes of GPU memory, as the driver says.
    [[nodiscard]] std::uint64_t bytes() const;

private:
    struct Picture {
        GlTexture texels;                    ///< of what is drawn; what lies outside is of another frame
        std::vector<PixelRectangle> painted; ///< first what is copied, then what is drawn
        std::size_t copied = 0;
    };
    /// The memory's texels go into the texture that is bound.
    void upload(std::span<const PixelRectangle> parts) const;

    std::unique_ptr<ReliefPainter> painter_; ///< none: no cast was prepared
    CastLight light_;
    Image8 memory_; ///< main memory that all are painted in, one after the other
    std::vector<Picture> pictures_;
    GlVertexArray no_attributes_ = GlVertexArray::generate();
};

} // namespace frustumscreen
