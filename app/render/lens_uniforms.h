/// What the passes share where the projector's lens distorts: its uniforms, and quadrilaterals in cells, since their edges are
/// no longer straight.
///
/// Accuracy  between the corners of a cell an edge is straight: over a face that fills the picture's half, behind a lens of
///           k1 = 0.1, at most 0.02 pixels beside its place.
/// Threads   the render thread.
#pragma once

#include "app/geometry/pinhole.h"
#include "app/render/shader_cache.h"
#include "app/scene/face_view.h"

#include <GLES3/gl32.h>

namespace frustumscreen {

/// Of a quadrilateral, along each side.
inline constexpr int quad_cells = 16;

/// After each `use` of a shader that bends; `pinhole` distorts.
inline void set_lens(const Shader& shader, const Pinhole& pinhole) {
    const glm::dvec2 half = 0.5 * glm::dvec2(pinhole.width, pinhole.height);
    const glm::dvec2 focal(pinhole.fx, pinhole.fy);
    const glm::dvec2 scale = half / focal;
    const glm::dvec2 offset = (half - glm::dvec2(pinhole.cx, pinhole.cy)) / focal;
    glUniform4f(shader.location(Uniform::LensFromClip), static_cast<float>(scale.x),
                static_cast<float>(scale.y), static_cast<float>(offset.x), static_cast<float>(offset.y));
    glUniform3f(shader.location(Uniform::Distortion), static_cast<float>(pinhole.lens.k1),
                static_cast<float>(pinhole.lens.k2), static_cast<float>(lens_limit(pinhole)));
}

/// Draws the quadrilateral of Uniform::Corners with the shader in use.
inline void draw_quad(bool bends) {
    if (bends) {
        glDrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 2 * (quad_cells + 1), quad_cells);
    } else {
        glDrawArrays(GL_TRIANGLE_FAN, 0, 4);
    }
}

} // namespace frustumscreen
