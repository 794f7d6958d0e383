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
#include "app/scene/frame_plan.h"
#include "app/scene/scene_plan.h"
#include "firmware_host/base/result.h"
#include "firmware_host/gl/gl_handle.h"

#include <array>
#include <optional>

namespace frustumscreen {

enum class FaceOutput {
    Colour,
    HitPoint, ///< prop coordinates, metres; alpha 1
};

class FacePass {
public:
    /// The artifact's shader in the variants that plans will ask for; others are not made. A plan of another
    /// kind is drawn with the nearest that there is.
    struct Variants {
        bool plain = true;       ///< colours as they are
        bool compensated = true; ///< light evened out
        bool level_fades = false;
        bool cut_out = false; ///< beside the others: an artifact may have texels that are cut out
    };
    [[nodiscard]] static Result<FacePass> create(FaceOutput output, const Variants& variants);
    /// Appends those that were made.
    void list_programs(std::vector<Program>& programs) const;

    /// The level that the plan is of, and the one that a fade brings in.
    struct Levels {
        const ArtifactGpu* artifact = nullptr;
        const ArtifactGpu* coming = nullptr;
    };
    /// Number of draw calls made. No level is touched if the plan has no face.
    int draw(const FramePlan& plan, const Levels& levels, const Raster& raster = {}) const;

private:
    /// Of the artifact's shader: bits of an index into `programs_`.
    enum Variant : unsigned { Compensated = 1, Fading = 2, CutOut = 4, AllVariants = 8 };
    struct ArtifactProgram {
        GlProgram program;
        GLint clip_from_unit = -1;
        GLint mip_level = -1;
        GLint brightness = -1;
        GLint pixel_from_fragment = -1;
        GLint pinhole = -1;
        GLint inverse_depth = -1;
        GLint gain = -1;
        GLint prop_from_unit = -1;
        GLint fade = -1;
    };
    FacePass() = default;
    [[nodiscard]] static Result<ArtifactProgram> make_artifact_program(std::string_view defines);
    [[nodiscard]] const ArtifactProgram* program_for(bool compensated, bool fading, bool cut_out) const;
    void upload_indices(const FramePlan& plan) const;
    void mark_faces(const FramePlan& plan, const Raster& raster) const;
    int draw_level(const FramePlan& plan, const ArtifactGpu& artifact, bool coming,
                   const Raster& raster) const;

    std::array<std::optional<ArtifactProgram>, AllVariants> programs_;
    GlProgram outline_;
    GLint outline_corners_ = -1;
    GlVertexArray no_attributes_;
    GlBuffer indices_; ///< the plan's, renewed with each picture
};

} // namespace frustumscreen
