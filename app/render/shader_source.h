/// The GLSL of each shader key. Vertices of outlines, pictures and tiles are made from gl_VertexID: they need
/// no buffer.
///
/// Threads  pure; any.
#pragma once

#include "app/scene/shader_key.h"

#include <string>
#include <string_view>

namespace frustumscreen {

struct ShaderSource {
    std::string defines;
    std::string vertex;
    std::string_view fragment;
};
/// `bends`: what it draws is bent as the projector's lens bends it, and quadrilaterals are drawn in cells (lens_uniforms.h).
[[nodiscard]] ShaderSource source_of(const ShaderKey& key, bool bends = false);

} // namespace frustumscreen
