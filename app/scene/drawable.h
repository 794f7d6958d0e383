/// Handles of the data in a renderer, given out at upload, and the look of a mesh. A plan names both.
///
/// Threads  values; any.
#pragma once

#include <cstdint>

namespace frustumscreen::scene {

/// Numbers of one renderer, which never reuses a number.
enum class MeshId : std::uint32_t { None };
enum class TextureId : std::uint32_t { None };

struct Material {
    TextureId texture = TextureId::None;
    double texels_per_box = 0.0; ///< along one box unit of the mesh (pack.h)
    bool cut_out = false;        ///< texels whose alpha is below one half are not drawn
};

struct Drawable {
    MeshId mesh = MeshId::None;
    Material material;
};

} // namespace frustumscreen::scene
