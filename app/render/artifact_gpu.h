/// One level of a pack in the GPU's memory: vertices and colour. Its triangles come with each plan.
///
/// Colour   the texture gives sRGB codes as they are stored; its mipmaps were averaged in linear light.
/// Threads  the render thread.
/// Errors   the driver has no memory, or the texture is larger than it allows.
#pragma once

#include "app/pack/pack.h"
#include "app/render/gl_handle.h"
#include "firmware_host/base/result.h"

namespace frustumscreen {

class ArtifactGpu {
public:
    [[nodiscard]] static Result<ArtifactGpu> upload(const Pack& pack, std::uint32_t level);

    [[nodiscard]] GLuint vertex_array() const { return vertex_array_.get(); }
    [[nodiscard]] GLuint texture() const { return texture_.get(); }
    /// The mip level whose texels are as large as a sample, one for a whole face: a software or small GPU
    /// spends more on finding and mixing two for each pixel than on the rest of it. `samples_per_box` as
    /// FacePlan::pixels_per_box, times the samples along a pixel's side.
    [[nodiscard]] float mip_level(double samples_per_box) const;
    /// Some of its texels are cut out (alpha below one half): only a renderer made for that leaves them out.
    [[nodiscard]] bool cut_out() const { return cut_out_; }

private:
    ArtifactGpu() = default;

    GlVertexArray vertex_array_;
    GlBuffer vertices_;
    GlTexture texture_;
    double texels_per_box_ = 0.0;
    bool cut_out_ = false;
};

} // namespace frustumscreen
