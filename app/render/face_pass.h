/// The one pass of the picture: visible faces into the stencil, then the artifact once for each face.
///
/// Draws into the framebuffer that is bound, inside the scissor that is set; the caller clears. Sets every
/// piece of state that it needs and leaves stencil test, depth test and culling off.
///
/// Colour   linear light out; an sRGB framebuffer encodes.
/// Threads  the render thread; allocates nothing in `draw`.
#pragma once

#include "app/render/artifact_gpu.h"
#include "app/render/gl_handle.h"
#include "app/scene/frame_plan.h"
#include "firmware_host/base/result.h"

namespace frustumscreen {

enum class FaceOutput {
    Colour,
    HitPoint, ///< prop coordinates, metres; alpha 1
};

class FacePass {
public:
    [[nodiscard]] static Result<FacePass> create(FaceOutput output);

    /// Number of draw calls made. `artifact` is not touched if the plan has no face.
    /// `fragments`: of the framebuffer, along the sides of one of the plan's pixels.
    int draw(const FramePlan& plan, const ArtifactGpu* artifact, const glm::ivec2& fragments = {1, 1}) const;

private:
    struct ArtifactProgram {
        GlProgram program;
        GLint clip_from_unit = -1;
        GLint level_bias = -1;
        GLint brightness = -1;
        GLint pixel_per_fragment = -1;
        GLint pinhole = -1;
        GLint inverse_depth = -1;
        GLint gain = -1;
        GLint prop_from_unit = -1;
    };
    FacePass() = default;
    [[nodiscard]] static Result<ArtifactProgram> make_artifact_program(std::string_view defines);
    void mark_faces(const FramePlan& plan) const;
    int draw_artifact(const FramePlan& plan, const ArtifactGpu& artifact, const glm::ivec2& fragments) const;

    ArtifactProgram plain_;
    ArtifactProgram compensated_;
    GlProgram outline_;
    GLint outline_corners_ = -1;
    GlVertexArray no_attributes_;
};

} // namespace frustumscreen
