/// The GLSL of each shader key. Vertices of outlines, pictures and tiles are made from gl_VertexID: they need
/// no buffer.
///
/// Threads  pure; any.
#pragma once

#include "app/scene/shader_key.h"

#include <string>

namespace frustumscreen {

/// Along each side of a quadrilateral that is bent. Between a cell's corners its edges are straight: over a face that fills the
/// picture's half, behind a lens of k1 = 0.1, at most 0.02 pixels beside their place.
inline constexpr int quad_cells = 16;

struct ShaderSource {
    std::string defines;
    std::string vertex;
    std::string fragment;
};
/// `bends`: what it draws is bent as the projector's lens bends it, and quadrilaterals are drawn in cells (Shader::draw_quad).
[[nodiscard]] ShaderSource source_of(const ShaderKey& key, bool bends = false);

} // namespace frustumscreen
