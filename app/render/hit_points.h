/// The second picture of a plan: not the colour but the place that each pixel shows. For measuring.
///
/// One sample at the pixel's centre. Never in the exhibit's frame.
#pragma once

#include "app/image/image.h"
#include "app/render/face_pass.h"
#include "firmware_host/gl/gl_handle.h"

namespace frustumscreen {

class HitPointRenderer {
public:
    /// Errors: the driver cannot draw into float pictures.
    [[nodiscard]] static Result<HitPointRenderer> create(int width, int height, bool cut_out = false);
    /// Hit points in prop coordinates, metres; NaN = no hit. Row 0 at the picture's top.
    [[nodiscard]] ImageFloat draw(const FramePlan& plan, const ArtifactGpu* artifact);

private:
    explicit HitPointRenderer(FacePass pass) : pass_(std::move(pass)) {}

    int width_ = 0;
    int height_ = 0;
    FacePass pass_;
    GlFramebuffer framebuffer_;
    GlRenderbuffer points_;
    GlRenderbuffer depth_stencil_;
};

} // namespace frustumscreen
