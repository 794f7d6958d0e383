/// The GLSL of each shader key. Vertices of outlines, pictures and tiles are computed from gl_VertexID,
/// without a buffer.
///
/// Threads  pure; any.
#pragma once

#include "app/scene/shader_key.h"

#include <string>

namespace frustumscreen::render {

/// Cells along each side of a quadrilateral that is bent. Between a cell's corners its edges are straight:
/// over a face that fills half of the picture, behind a lens of k1 = 0.1, they are at most 0.02 pixels off.
inline constexpr int quad_cells = 16;

struct ShaderSource {
    std::string defines;
    std::string vertex;
    std::string fragment;
};
/// `bends`: draws are distorted like the projector's lens, and quadrilaterals are drawn in cells
/// (Shader::draw_quad).
[[nodiscard]] ShaderSource source_of(const scene::ShaderKey& key, bool bends = false);

} // namespace frustumscreen::render
