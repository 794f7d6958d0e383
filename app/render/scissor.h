/// The scissor, in the plan's pixels.
///
/// Threads  the render thread.
#pragma once

#include "app/scene/lit_tiles.h"

#include <GLES3/gl32.h>
#include <glm/glm.hpp>

namespace frustumscreen {

/// `fragments`: of the framebuffer, along the sides of one of the plan's pixels.
inline void set_scissor(const PixelRectangle& r, const glm::ivec2& fragments = {1, 1}) {
    glScissor(r.x * fragments.x, r.y * fragments.y, r.width * fragments.x, r.height * fragments.y);
}

} // namespace frustumscreen
