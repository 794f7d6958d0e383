/// One level of a pack in the GPU's memory: vertices and colour. Its triangles come with each plan.
///
/// Threads  the render thread.
/// Errors   the driver has no memory, or the texture is larger than it allows.
#pragma once

#include "app/pack/pack.h"
#include "app/render/gl_handle.h"
#include "firmware_host/base/result.h"

namespace frustumscreen {

struct TextureFilter {
    /// Texels along the longer axis of a pixel's footprint for each one along the shorter; 1 = isotropic.
    /// Used where the driver has EXT_texture_filter_anisotropic.
    float anisotropy = 1.0F;
    /// Added to the mip level: below 0 sharper. A steep face shows texels 4 : 1 foreshortened, which
    /// isotropic mip levels blur; one level sharper halves the colour error of textured artifacts and costs
    /// nothing.
    float level_bias = -1.0F;
};

class ArtifactGpu {
public:
    [[nodiscard]] static Result<ArtifactGpu> upload(const Pack& pack, std::uint32_t level,
                                                    const TextureFilter& filter = {});

    [[nodiscard]] GLuint vertex_array() const { return vertex_array_.get(); }
    [[nodiscard]] GLuint texture() const { return texture_.get(); }
    [[nodiscard]] float level_bias() const { return level_bias_; }

private:
    ArtifactGpu() = default;

    GlVertexArray vertex_array_;
    GlBuffer vertices_;
    GlTexture texture_;
    float level_bias_ = 0.0F;
};

} // namespace frustumscreen
