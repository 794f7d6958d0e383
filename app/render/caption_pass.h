/// Captions: a picture of text that lies flat on the table, never on the prop.
///
/// Colour   white light, its coverage in linear light.
/// Threads  the render thread; allocates nothing in `draw`.
#pragma once

#include "app/image/image.h"
#include "app/render/shader_cache.h"
#include "app/scene/frame_plan.h"
#include "firmware_host/base/result.h"
#include "firmware_host/gl/gl_handle.h"

#include <cstdint>

namespace frustumscreen {

/// A caption's coverage in the GPU's memory.
class CaptionGpu {
public:
    /// Coverage 0..255, row 0 at the text's top. Errors: larger than the driver allows.
    [[nodiscard]] static Result<CaptionGpu> upload(const Image<std::uint8_t>& coverage);
    [[nodiscard]] GLuint texture() const { return texture_.get(); }
    /// Of GPU memory, as the driver says.
    [[nodiscard]] std::uint64_t bytes() const;

private:
    CaptionGpu() = default;
    GlTexture texture_;
};

class CaptionPass {
public:
    [[nodiscard]] static CaptionPass create();
    /// Draws the caption, then blackens the prop. Number of draw calls; nothing without a caption.
    int draw(const CaptionPlan& plan, const CaptionGpu* caption, const ShaderCache& shaders) const;

private:
    CaptionPass() = default;
    GlVertexArray no_attributes_;
};

} // namespace frustumscreen
