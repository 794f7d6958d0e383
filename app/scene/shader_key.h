/// Names a shader by what it does and not by how: a plan makes keys, a renderer compiles one program for
/// each.
///
/// Threads  values; any.
#pragma once

#include "app/geometry/pinhole.h"
#include "firmware_host/base/pixel_rectangle.h"

#include <compare>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <set>
#include <string>

namespace frustumscreen {

struct ShaderKey {
    enum class Pass : std::uint8_t {
        Outline,         ///< marks a face of the prop
        Surface,         ///< draws a mesh, or a relief's blocks
        Cast,            ///< shows what was cast into memory
        EdgeFeather,     ///< dims a strip of a face
        TablePicture,    ///< draws a flat picture beside the prop
        TileClear,       ///< blackens tiles of the larger picture that several samples a pixel need
        TileAverage,     ///< averages these samples, up to 2 x 2 a pixel
        TileAverageMany, ///< the same of more
    };
    Pass pass = Pass::Surface;
    // Of surfaces alone, but the third, of casts too:
    bool places : 1 = false;     ///< gives each pixel's place in the prop and not its colour
    bool cut_out : 1 = false;    ///< leaves out texels whose alpha is below one half
    bool dithered : 1 = false;   ///< draws a share of the pixels
    bool even_light : 1 = false; ///< evens out the projector's light
    bool blocks : 1 = false;     ///< draws a relief's blocks, which leave out no texels

    [[nodiscard]] auto operator<=>(const ShaderKey&) const = default;
};
[[nodiscard]] std::string name_of(const ShaderKey& key);
/// The bits are equal only for equal keys.
[[nodiscard]] std::uint32_t bits_of(const ShaderKey& key);

/// The shader that gives the places of what `key` draws.
[[nodiscard]] ShaderKey places_of(ShaderKey key);

/// The shader of what was cast.
[[nodiscard]] ShaderKey cast_shader(bool dithered);

/// What a renderer must be able to do.
struct RenderNeeds {
    int samples = 1;           ///< a pixel, that there is room for wherever the prop may stand
    std::set<ShaderKey> draws; ///< the shaders that the draws of its plans name
    std::size_t casts = 0;     ///< pictures that one plan may cast into memory
    /// The largest rectangle around the prop in the picture (prop_outline.h); none: all of the picture.
    std::optional<PixelSize> outline = std::nullopt;
    std::optional<Pinhole> bent_by =
        std::nullopt; ///< a projector whose lens distorts: every shader bends what it draws
};
/// The projector, if its lens distorts: RenderNeeds::bent_by.
[[nodiscard]] std::optional<Pinhole> if_it_bends(const Pinhole& projector);
[[nodiscard]] RenderNeeds united(const RenderNeeds& a, const RenderNeeds& b);
/// Every shader that a renderer with these needs compiles: those of the draws, and those that it brings
/// itself.
[[nodiscard]] std::set<ShaderKey> shaders_of(const RenderNeeds& needs);

} // namespace frustumscreen
