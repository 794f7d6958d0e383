/// The one pass of the picture: visible faces into the stencil, then the artifact once for each face.
///
/// While one level of the artifact fades into another, both are drawn, and an ordered dither gives each of
/// the picture's pixels, with all its samples, to exactly one of them: no pixel is a mixture and none is left
/// out.
///
/// Draws into the framebuffer that is bound; the caller clears. Sets every piece of state that it needs, the
/// scissor to each face's bounds, and leaves stencil test, depth test and culling off.
///
/// Colour   sRGB codes in and out: the framebuffer must take them as they are (GL_FRAMEBUFFER_SRGB_EXT off).
///          Decoding and encoding every sample costs a software GPU more than the rest of it.
/// Threads  the render thread; allocates nothing in `draw`.
#pragma once

#include "app/render/artifact_gpu.h"
#include "app/render/raster.h"
#include "app/render/shader_cache.h"
#include "app/scene/frame_plan.h"
#include "firmware_host/gl/gl_handle.h"

namespace frustumscreen {

class FacePass {
public:
    [[nodiscard]] static FacePass create();

    /// The level that the plan is of, and the one that a fade brings in.
    struct Levels {
        const ArtifactGpu* artifact = nullptr;
        const ArtifactGpu* coming = nullptr;
    };
    enum class Output {
        Colours,
        Places ///< prop coordinates, metres; alpha 1
    };
    /// Number of draw calls made. No level is touched if the plan has no face. What needs a shader that was
    /// not prepared is left out.
    int draw(const FramePlan& plan, const Levels& levels, const ShaderCache& shaders,
             const Raster& raster = {}, Output output = Output::Colours) const;

private:
    FacePass() = default;
    void upload_indices(const FramePlan& plan) const;
    void mark_faces(const FramePlan& plan, const Shader& outline, const Raster& raster) const;
    int draw_level(const FramePlan& plan, const ArtifactGpu& artifact, const Shader& shader, bool coming,
                   const Raster& raster) const;

    GlVertexArray no_attributes_;
    GlBuffer indices_; ///< the plan's, renewed with each picture
};

} // namespace frustumscreen
