/// The layout of the plan's pixels in a framebuffer: the fragments of each pixel, and the first pixel.
///
/// Threads  values; the setters, the render thread.
#pragma once

#include "app/scene/lit_tiles.h"

#include <GLES3/gl32.h>
#include <glm/glm.hpp>

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

/// The colours that are written; alpha always is.
inline void set_channels(const glm::bvec3& channels) {
    glColorMask(channels.r ? GL_TRUE : GL_FALSE, channels.g ? GL_TRUE : GL_FALSE,
                channels.b ? GL_TRUE : GL_FALSE, GL_TRUE);
}

} // namespace frustumscreen::render
