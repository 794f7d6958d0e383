/// Names a shader by what it does, not how: a plan makes keys, a renderer compiles one program for each key.
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

namespace frustumscreen::scene {

struct ShaderKey {
    enum class Pass : std::uint8_t {
        Outline,         ///< marks a face of the prop
        Surface,         ///< draws a mesh, or a relief's blocks
        Raster,          ///< shows a relief that was rasterized into memory
        EdgeFeather,     ///< dims a strip of a face
        TablePicture,    ///< draws a flat picture on the table
        TileClear,       ///< blackens tiles of the larger picture that holds several samples a pixel
        TileAverage,     ///< averages these samples, up to 2 x 2 a pixel
        TileAverageMany, ///< averages more samples than that
        RasterInDepth,   ///< shows such a relief behind and before what the GPU draws
        TorchOnSamples,  ///< a torch on the averaged samples, by their depth
        TorchOnPixels,   ///< a torch on pixels of one sample each, by their depth
        FarthestDepths,  ///< makes a torch's shadow map of the depths that the GPU has drawn
    };
    Pass pass = Pass::Surface;
    // For Surface only:
    bool places : 1 = false;     ///< outputs each pixel's position in the prop instead of its colour
    bool cut_out : 1 = false;    ///< leaves out texels whose alpha is below one half
    bool dithered : 1 = false;   ///< draws a share of the pixels
    bool even_light : 1 = false; ///< evens out the projector's light
    bool blocks : 1 = false;     ///< draws a relief's blocks, which leave out no texels
    bool coloured : 1 = false;   ///< multiplies its colours by the draw's light
    // For Surface, Raster, RasterInDepth, TorchOnSamples and TorchOnPixels:
    bool torch : 1 = false;        ///< outputs a torch's light on what was drawn, to be blended
    std::uint8_t content : 7 = 0U; ///< torch::ContentPart, bits

    [[nodiscard]] auto operator<=>(const ShaderKey&) const = default;
};
[[nodiscard]] std::string name_of(const ShaderKey& key);
/// The bits are equal only for equal keys.
[[nodiscard]] std::uint32_t bits_of(const ShaderKey& key);

/// The shader that outputs positions for the draws of `key`.
[[nodiscard]] ShaderKey places_of(ShaderKey key);

/// The shader for reliefs that are rasterized on the processor.
[[nodiscard]] ShaderKey raster_shader();

/// Capabilities and memory that a renderer must provide.
struct RenderNeeds {
    int samples = 1;           ///< samples a pixel that the target must hold wherever the prop stands
    std::set<ShaderKey> draws; ///< the shaders that the draws of its plans name
    bool rasterizes = false;   ///< a plan may rasterize reliefs into memory, all into one picture
    bool interlocks = false;   ///< such a relief may hide, or be hidden by, what the GPU draws
    std::set<std::uint8_t>
        torches{}; ///< the contents of a plan's torches, by torch::ContentPart; empty: it has none
    /// Largest rectangle around the prop in the picture (prop_outline.h); nullopt: the whole picture.
    std::optional<PixelSize> outline = std::nullopt;
    std::optional<geometry::Pinhole> bent_by =
        std::nullopt; ///< set for a projector whose lens distorts: every shader bends what it draws
};
/// The value of RenderNeeds::bent_by: the projector if its lens distorts, otherwise nullopt.
[[nodiscard]] std::optional<geometry::Pinhole> if_it_bends(const geometry::Pinhole& projector);
[[nodiscard]] RenderNeeds united(const RenderNeeds& a, const RenderNeeds& b);
/// The shaders that a world of cells needs beyond its artifact's: a light for each, and depth between relief and polygons.
[[nodiscard]] RenderNeeds with_cells(RenderNeeds needs);
/// The shaders of a torch with content of these parts (torch::parts_of), beyond those of the surfaces that it lights.
[[nodiscard]] RenderNeeds with_torch(RenderNeeds needs, std::uint8_t content);
/// The shaders of torches with any content: the usual ones have shaders of their own.
[[nodiscard]] RenderNeeds with_torches(RenderNeeds needs);
/// The shader that draws again, in a torch's light, what `key` has drawn.
[[nodiscard]] ShaderKey torch_of(ShaderKey key, std::uint8_t content);
/// Every shader that a renderer with these needs compiles: those of the draws and the renderer's own.
[[nodiscard]] std::set<ShaderKey> shaders_of(const RenderNeeds& needs);

} // namespace frustumscreen::scene
