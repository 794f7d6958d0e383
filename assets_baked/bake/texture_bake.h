/// Colours for a charted surface, looked up on the source, and the museum's light on it.
///
/// Frames   box. Colour in linear light until the last step; out as 8-bit sRGB.
/// Threads  uses all cores; deterministic.
#pragma once

#include "app/image/image.h"
#include "assets_baked/bake/charts.h"
#include "assets_baked/bake/file_normals.h"
#include "assets_baked/bake/part_light.h"
#include "assets_baked/bake/source_scene.h"

#include <glm/glm.hpp>

#include <optional>

namespace frustumscreen::bake {

/// The content of an atlas texel: a point on a triangle of the charted mesh.
struct AtlasTexel {
    std::uint32_t triangle = 0xFFFFFFFFU; ///< 0xFFFFFFFF: none
    float u = 0.0F, v = 0.0F;             ///< barycentric weights of the second and third corner
};

/// Assigns every texel within the gutter of a triangle the nearest point on the triangle.
[[nodiscard]] image::Image<AtlasTexel> rasterise(const ChartedMesh& mesh);

/// Base colour of the source, linear, for each texel. `reach_box`: largest distance of the level from the
/// source.
[[nodiscard]] image::ImageFloat bake_colour(const ChartedMesh& mesh, const image::Image<AtlasTexel>& texels,
                                            const SourceScene& source, float reach_box);

/// A layer's colour, linear, for each texel, and its alpha, which weighs the colours that a texel is the mean of.
/// `texels`: those of `mesh`.
struct LayerColour {
    image::ImageFloat colour;
    image::Image<float> alpha; ///< 0..1
};
[[nodiscard]] LayerColour bake_layer(const ChartedMesh& mesh, const image::Image<AtlasTexel>& texels,
                                     const SourceScene& source, const SourceLayer& layer, float reach_box);
/// As `finish`, with the layer's alpha.
/// Where the layer is transparent it gets the colours of the artifact, and then covers all. `coverage`: as of finish.
void cover(LayerColour& layer, const image::ImageFloat& colour, const image::Image<float>& coverage,
           const image::Image<AtlasTexel>& texels);
[[nodiscard]] image::Image8 finish_layer(const LayerColour& layer, const image::Image<AtlasTexel>& texels);

/// Share of each texel that alpha MASK keeps, 0..1; below one half it is cut. Empty for a source without such
/// a material.
[[nodiscard]] image::Image<float> bake_coverage(const ChartedMesh& mesh,
                                                const image::Image<AtlasTexel>& texels,
                                                const SourceScene& source, float reach_box);

/// Light on each texel, 1 = an open surface facing the key light; soft dome and key, shadowed by the artifact
/// itself and by the table it stands on (ambient occlusion). `normals` are those of the source's mesh; `place` of a
/// source that is a part.
[[nodiscard]] image::ImageFloat bake_light(const ChartedMesh& mesh, const image::Image<AtlasTexel>& texels,
                                           const SourceScene& source, const FileNormals& normals,
                                           float reach_box,
                                           const std::optional<PlaceInWhole>& place = std::nullopt);

/// Converts to sRGB. Texels that no triangle covers, or that alpha cuts, take their neighbours' colour, so
/// that mipmaps and filtering do not bleed. `coverage` becomes alpha; empty = no texel is cut.
[[nodiscard]] image::Image8 finish(const image::ImageFloat& colour, const image::Image<AtlasTexel>& texels,
                                   const image::Image<float>& coverage = {});

} // namespace frustumscreen::bake
