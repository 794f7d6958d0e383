/// Draws flat surfaces as seen by an eye, lit by the exhibit's picture: the visitor's half of the window.
///
/// Light    linear: a surface reflects `gain` times the picture's light and adds `own`; the output is in sRGB
///          codes.
/// Threads  the window's copying context is current; its GL state is changed.
/// Errors   the driver rejects the shaders.
#pragma once

#include "firmware_host/base/pixel_rectangle.h"
#include "firmware_host/base/result.h"
#include "firmware_host/display/picture_framebuffer.h"
#include "firmware_host/gl/gl_handle.h"

#include <glm/glm.hpp>

#include <vector>

namespace frustumscreen::window {

struct SeenVertex {
    glm::vec4 clip{0.0F};    ///< in the visitor's view, OpenGL's clip coordinates
    glm::vec3 picture{0.0F}; ///< homogeneous: (u, v) = xy / z in the picture (0..1, 0 at the top left)
    float gain = 0.0F;
    glm::vec3 own{0.0F};
};

/// Drawn in their order, the later over the earlier; then the lines.
struct SeenSurfaces {
    std::vector<SeenVertex> triangles; ///< three vertices each
    std::vector<SeenVertex> lines;     ///< two vertices each
};

class SeenSurfacesPass {
public:
    [[nodiscard]] static Result<SeenSurfacesPass> create();
    /// Draws into `place` of the bound framebuffer, over black; rows count from the bottom.
    void draw(const display::PictureFramebuffer& picture, const SeenSurfaces& seen,
              const PixelRectangle& place) const;

private:
    explicit SeenSurfacesPass(gl::GlProgram program);
    void draw(const std::vector<SeenVertex>& vertices, GLenum shape) const;

    gl::GlProgram program_;
    gl::GlBuffer buffer_ = gl::GlBuffer::generate();
    gl::GlVertexArray vertices_ = gl::GlVertexArray::generate();
    gl::GlSampler sampler_ = gl::GlSampler::generate();
};

} // namespace frustumscreen::window
