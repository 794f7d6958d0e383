/// The layout of the plan's pixels in a framebuffer: the fragments of each pixel, and the first pixel.
///
/// Threads  values; the setters, the render thread.
#pragma once

#include "app/geometry/pinhole.h"
#include "app/scene/lit_tiles.h"

#include <GLES3/gl32.h>
#include <glm/glm.hpp>

#include <cstddef>

namespace frustumscreen::render {

struct Raster {
    glm::ivec2 fragments{1, 1}; ///< along the sides of one pixel
    glm::ivec2 corner{0,
                      0}; ///< the pixel at the framebuffer's fragment (0, 0); negative for an eye's viewport
};

/// `picture`: its size in pixels.
inline void set_viewport(const glm::ivec2& picture, const Raster& raster) {
    const glm::ivec2 first = -raster.corner * raster.fragments;
    const glm::ivec2 size = picture * raster.fragments;
    glViewport(first.x, first.y, size.x, size.y);
}

inline void set_scissor(const PixelRectangle& r, const Raster& raster = {}) {
    const glm::ivec2 first = (glm::ivec2(r.x, r.y) - raster.corner) * raster.fragments;
    const glm::ivec2 size = glm::ivec2(r.width, r.height) * raster.fragments;
    glScissor(first.x, first.y, size.x, size.y);
}

/// Scale and offset that take a fragment to the direction (x, y) of its ideal ray, whose z is 1.
inline glm::vec4 ray_from_fragment(const geometry::Pinhole& pinhole, const Raster& raster) {
    const glm::dvec2 per_pixel = 1.0 / glm::dvec2(pinhole.fx, pinhole.fy);
    return {glm::vec2(per_pixel / glm::dvec2(raster.fragments)),
            glm::vec2((glm::dvec2(raster.corner) - glm::dvec2(pinhole.cx, pinhole.cy)) * per_pixel)};
}

/// The value that a face of the plan has in the stencil.
inline GLuint stencil_value(std::size_t face) {
    return static_cast<GLuint>(face) + 1U;
}

/// The colours that are written; alpha always is.
inline void set_channels(const glm::bvec3& channels) {
    glColorMask(channels.r ? GL_TRUE : GL_FALSE, channels.g ? GL_TRUE : GL_FALSE,
                channels.b ? GL_TRUE : GL_FALSE, GL_TRUE);
}

} // namespace frustumscreen::render
