/// One level of a pack in the GPU's memory: vertices and colour. Its triangles come with each plan.
///
/// Colour   the texture gives sRGB codes as they are stored; its mip levels are averaged in linear light,
///          here and not by the driver: the same everywhere, and the finest need not go to the GPU to make
///          the rest.
/// Threads  the render thread.
/// Errors   the driver has no memory, or the texture is larger than it allows.
#pragma once

#include "app/pack/pack.h"
#include "app/scene/scene_level.h"
#include "firmware_host/base/result.h"
#include "firmware_host/gl/gl_handle.h"

namespace frustumscreen {

class ArtifactGpu {
public:
    /// All of a level.
    [[nodiscard]] static Result<ArtifactGpu> upload(const Pack& pack, std::uint32_t level);
    /// What a scene needs of it; `texture` is the level's, whole.
    [[nodiscard]] static Result<ArtifactGpu> upload(const SceneLevel& level, const Image8& texture);

    [[nodiscard]] GLuint vertex_array() const { return vertex_array_.get(); }
    [[nodiscard]] GLuint texture() const { return texture_.get(); }
    /// The uploaded mip level that ::mip_level asks for, one for a whole face: a software or small GPU spends
    /// more on finding and mixing two for each pixel than on the rest of it.
    [[nodiscard]] float mip_level(double samples_per_box) const;
    /// Some of its texels are cut out (alpha below one half): only a renderer made for that leaves them out.
    [[nodiscard]] bool cut_out() const { return cut_out_; }
    /// Of GPU memory, as the driver says.
    [[nodiscard]] std::uint64_t bytes() const;

private:
    ArtifactGpu() = default;

    GlVertexArray vertex_array_;
    GlBuffer vertices_;
    GlTexture texture_;
    double texels_per_box_ = 0.0;
    int finest_mip_ = 0;
    bool cut_out_ = false;
};

} // namespace frustumscreen
