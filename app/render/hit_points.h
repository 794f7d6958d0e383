/// A second picture of a plan for measuring: each pixel's position on the artifact instead of its colour.
///
/// One sample at the pixel's centre. Never in the exhibit's frame.
///
/// Threads  the render thread.
#pragma once

#include "app/image/image.h"
#include "app/relief/relief_painter.h"
#include "app/render/face_pass.h"
#include "app/render/gpu_store.h"
#include "app/render/renderer.h"
#include "app/render/shader_cache.h"
#include "firmware_host/base/result.h"
#include "firmware_host/gl/gl_handle.h"

namespace frustumscreen::render {

class HitPointRenderer {
public:
    /// Errors: the driver cannot draw into float pictures. It has the shaders that `renderer` has at this
    /// time.
    [[nodiscard]] static Result<HitPointRenderer> create(const Renderer& renderer);
    /// Hit points in prop coordinates, metres; NaN = no hit. Row 0 at the picture's top. `store`: the same
    /// renderer's.
    [[nodiscard]] image::ImageFloat draw(const scene::FramePlan& plan, const GpuStore& store);

private:
    /// Adds the rasterized reliefs where they are nearer than the GPU's draws.
    void add_rasters(const scene::FramePlan& plan, const GpuStore& store, image::ImageFloat& points);
    HitPointRenderer(int width, int height) : width_(width), height_(height) {}

    int width_;
    int height_;
    ShaderCache shaders_;
    FacePass pass_;
    std::unique_ptr<relief::ReliefPainter> painter_ = std::make_unique<relief::ReliefPainter>(1);
    gl::GlFramebuffer framebuffer_;
    gl::GlRenderbuffer points_;
    gl::GlRenderbuffer depth_stencil_;
};

} // namespace frustumscreen::render
