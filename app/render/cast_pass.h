/// Reliefs cast on the processor, as pictures in the GPU's memory: what a plan's casts see, for the draws that name them.
///
/// Colour   sRGB codes of the artifact as they are; alpha 0 where nothing was met.
/// Threads  the render thread, with as many more of its own as there are further cores; `paint` allocates nothing once a picture as
///          full was painted, and makes no GL object.
/// Errors   the driver has no memory.
#pragma once

#include "app/image/image.h"
#include "app/relief/relief_painter.h"
#include "app/render/gpu_store.h"
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
    struct Picture {
        GlTexture texels;
        PixelRectangle lit; ///< empty: nothing was painted; what lies outside is of another frame
    };
    /// Null for one that there is no room for.
    [[nodiscard]] const Picture* find(std::size_t cast) const {
        return cast < pictures_.size() ? &pictures_[cast] : nullptr;
    }

    /// Bytes of GPU memory, as the driver says.
    [[nodiscard]] std::uint64_t bytes() const;

private:
    void upload(const Picture& picture) const;

    std::unique_ptr<ReliefPainter> painter_; ///< none: no cast was prepared
    Image8 memory_;                          ///< main memory that all are painted in, one after the other
    std::vector<Picture> pictures_;
};

} // namespace frustumscreen
