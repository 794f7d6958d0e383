/// Colours for a charted surface, looked up on the source, and the museum's light on it.
///
/// Frames   box. Colour in linear light until the last step; out as 8-bit sRGB.
/// Threads  uses all cores; deterministic.
#pragma once

#include "app/image/image.h"
#include "assets_baked/bake/charts.h"
#include "assets_baked/bake/source_scene.h"

#include <glm/glm.hpp>

#include <functional>
#include <vector>

namespace frustumscreen {

/// What an atlas texel shows: a point on a triangle of the charted mesh.
struct AtlasTexel {
    std::uint32_t triangle = 0xFFFFFFFFU; ///< 0xFFFFFFFF: nothing
    float u = 0.0F, v = 0.0F;             ///< barycentric weights of the second and third corner
};

/// Every texel within the gutter of a triangle gets the nearest point of it.
[[nodiscard]] Image<AtlasTexel> rasterise(const ChartedMesh& mesh);

/// Base colour of the source, linear, for each texel. `reach_box`: how far the level strays from the source.
[[nodiscard]] ImageFloat bake_colour(const ChartedMesh& mesh, const Image<AtlasTexel>& texels,
                                     const SourceScene& source, float reach_box);

/// How much of each texel alpha MASK leaves, 0..1, cut where it is below one half; empty for a source that
/// has no such material.
[[nodiscard]] Image<float> bake_coverage(const ChartedMesh& mesh, const Image<AtlasTexel>& texels,
                                         const SourceScene& source, float reach_box);

/// Light that falls on each texel, 1 = an open surface facing the key light; soft dome and key, hidden by the
/// artifact itself and by the table it stands on (ambient occlusion).
[[nodiscard]] ImageFloat bake_light(const ChartedMesh& mesh, const Image<AtlasTexel>& texels,
                                    const SourceScene& source);

/// The light of one baked level, looked up from another.
[[nodiscard]] ImageFloat transfer_light(const ChartedMesh& to, const Image<AtlasTexel>& to_texels,
                                        const ChartedMesh& from, const ImageFloat& from_light,
                                        float reach_box);

/// To sRGB; what no triangle covers, or alpha cuts, takes its neighbours' colour, so that neither mipmaps nor
/// the filter bleed. `coverage` becomes alpha; empty = all of it is there.
[[nodiscard]] Image8 finish(const ImageFloat& colour, const Image<AtlasTexel>& texels,
                            const Image<float>& coverage = {});

} // namespace frustumscreen
