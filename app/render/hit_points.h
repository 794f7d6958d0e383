/// The second picture of a plan: not the colour but the place that each pixel shows. For measuring.
///
/// One sample at the pixel's centre. Never in the exhibit's frame.
#pragma once

#include "app/image/image.h"
#include "app/render/face_pass.h"
#include "firmware_host/gl/gl_handle.h"

#include <set>

namespace frustumscreen {

class HitPointRenderer {
public:
    /// Errors: the driver cannot draw into float pictures.
    /// `draws`: of the renderer whose plans these are.
    [[nodiscard]] static Result<HitPointRenderer> create(int width, int height,
                                                         const std::set<ShaderKey>& draws);
    /// Hit points in prop coordinates, metres; NaN = no hit. Row 0 at the picture's top.
    [[nodiscard]] ImageFloat draw(const FramePlan& plan, const ArtifactGpu* artifact);

private:
    HitPointRenderer(int width, int height) : width_(width), height_(height) {}

    int width_;
    int height_;
    ShaderCache shaders_;
    FacePass pass_ = FacePass::create();
    GlFramebuffer framebuffer_;
    GlRenderbuffer points_;
    GlRenderbuffer depth_stencil_;
};

} // namespace frustumscreen
