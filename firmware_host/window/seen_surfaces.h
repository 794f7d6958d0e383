/// Draws flat surfaces as an eye sees them, lit by the exhibit's picture: the visitor's half of the window.
///
/// Light    linear: a surface sends back `gain` times the picture's light and `own` besides; codes are written.
/// Threads  the window's copying context is current; its GL state is left changed.
/// Errors   the driver does not take the shaders.
#pragma once

#include "firmware_host/base/pixel_rectangle.h"
#include "firmware_host/base/result.h"
#include "firmware_host/display/picture_framebuffer.h"
#include "firmware_host/gl/gl_handle.h"

#include <glm/glm.hpp>

#include <vector>

namespace frustumscreen {

struct SeenVertex {
    glm::vec4 clip{0.0F};    ///< in the visitor's view, OpenGL's clip coordinates
    glm::vec3 picture{0.0F}; ///< homogeneous: (u, v) = xy / z is the picture's (0..1, 0 at the top left)
    float gain = 0.0F;
    glm::vec3 own{0.0F};
};

/// Drawn in their order, the later over the earlier; then the lines.
struct SeenSurfaces {
    std::vector<SeenVertex> triangles; ///< three each
    std::vector<SeenVertex> lines;     ///< two each
};

class SeenSurfacesPass {
public:
    [[nodiscard]] static Result<SeenSurfacesPass> create();
    /// Into `place` of the bound framebuffer, over black; rows count from the bottom.
    void draw(const PictureFramebuffer& picture, const SeenSurfaces& seen, const PixelRectangle& place) const;

private:
    explicit SeenSurfacesPass(GlProgram program);
    void draw(const std::vector<SeenVertex>& vertices, GLenum shape) const;

    GlProgram program_;
    GlBuffer buffer_ = GlBuffer::generate();
    GlVertexArray vertices_ = GlVertexArray::generate();
    GlSampler sampler_ = GlSampler::generate();
};

} // namespace frustumscreen
