/// Handles of the data in a renderer, given out at upload, and the look of a mesh. A plan names both.
///
/// Threads  values; any.
#pragma once

#include <array>
#include <cstddef>
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

/// Other textures of one surface, which torches show.
inline constexpr std::size_t max_layers = 4;

struct Drawable {
    MeshId mesh = MeshId::None;
    Material material;
    std::array<TextureId, max_layers>
        layers{}; ///< as Material::texture; of a relief, other colours of its corners
};

} // namespace frustumscreen::scene
