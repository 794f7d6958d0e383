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
    std::string_view vertex, fragment;
};
[[nodiscard]] ShaderSource source_of(const ShaderKey& key);

} // namespace frustumscreen
