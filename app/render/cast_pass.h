/// Reliefs cast on the processor, as pictures in the GPU's memory: what a plan's casts see, for the draws that name them.
///
/// They are drawn into the framebuffer that is bound, a pixel for a pixel, over what stands there; state as FacePass.
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
#include <vector>

namespace frustumscreen {

class CastPass {
public:
    /// Has room for so many casts a plan, of the whole picture each.
    [[nodiscard]] Result<void> prepare(std::size_t casts, int width, int height);

    /// Casts all of the plan's, and uploads what they light. Those whose relief is not in the store stay out.
    void paint(const FramePlan& plan, const GpuStore& store);
    /// Draws what was painted for this plan; returns the number of draw calls.
    int draw(const FramePlan& plan, const ShaderCache& shaders) const;

    /// Bytes of GPU memory, as the driver says.
    [[nodiscard]] std::uint64_t bytes() const;

private:
    struct Picture {
        GlTexture texels;
        std::vector<PixelRectangle> painted; ///< what lies outside is of another frame
    };
    void upload(const Picture& picture) const;

    std::unique_ptr<ReliefPainter> painter_; ///< none: no cast was prepared
    CastLight light_;
    Image8 memory_; ///< main memory that all are painted in, one after the other
    std::vector<Picture> pictures_;
    GlVertexArray no_attributes_ = GlVertexArray::generate();
};

} // namespace frustumscreen
