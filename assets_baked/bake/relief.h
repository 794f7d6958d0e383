/// Layered relief: every front-facing crossing of the orthographic rays in the prop's face directions. The
/// face that sees a crossing best keeps it; the samples are cut into charts that overlap by rings and packed
/// in one atlas.
///
/// Frames   box; a chart's texels form a grid of pitch `texel_box` across its direction, depth along it.
/// Threads  uses all cores; deterministic.
/// Source   layered depth images (Shade 1998) as relief textures (Oliveira 2000; Kim 2008) with their holes
///          closed.
#pragma once

#include "app/pack/pack.h"
#include "assets_baked/bake/charts.h"
#include "assets_baked/bake/source_scene.h"

#include <optional>
#include <vector>

namespace frustumscreen {

struct BakedRelief {
    ReliefAtlas atlas;
    ImageFloat colour; ///< linear base colour of each texel
    ChartedMesh grid;  ///< two triangles for every four linked texels; uv at texel centres
    struct Range {
        std::uint32_t first_vertex, vertex_count, first_index, index_count;
    };
    std::vector<Range> charts; ///< each chart's own part of `grid`
};

/// `visible`: what a visitor sees (with flipped copies); other crossings are left out. Returns nothing if the
/// atlas would exceed `largest_atlas` texels a side (too many layers for a relief).
[[nodiscard]] std::optional<BakedRelief> bake_relief(const SourceScene& source, const TriangleMesh& visible,
                                                     const glm::dvec3& box_size,
                                                     const std::vector<ReliefDirection>& directions,
                                                     int texels_along_longest_edge, int largest_atlas = 4096);

/// The grid with the fewest triangles that stay within `tolerance_box`; its vertices are still texels of the
/// atlas.
[[nodiscard]] ChartedMesh simplify_grid(const BakedRelief& relief, float tolerance_box);

} // namespace frustumscreen
