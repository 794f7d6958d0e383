/// Cuts a surface into charts that each have one orthographic projection without overlap, and lays them out
/// in an atlas. A chart's map is linear in position, so moving a vertex along its surface never distorts the
/// colour.
///
/// Frames   positions in the box frame; uv in texels of the atlas (texel centres at .5).
/// Threads  pure; any.
#pragma once

#include "assets_baked/bake/triangle_mesh.h"

#include <glm/glm.hpp>

#include <cstdint>
#include <vector>

namespace frustumscreen {

struct ChartedMesh {
    int atlas_width = 0;
    int atlas_height = 0;
    std::vector<glm::vec3> positions; ///< split at chart borders; equal positions stay bit-equal
    std::vector<glm::vec3> normals;   ///< unit, smooth across chart borders, one each position
    std::vector<glm::vec2> uv_texels;
    std::vector<std::uint32_t> indices;
    std::size_t chart_count = 0;
};

/// Texels of padding on every side of a chart.
inline constexpr int chart_gutter_texels = 3;

/// `texel_box` is the edge of a texel in box units; it grows if the atlas would exceed `largest_atlas` texels
/// a side.
[[nodiscard]] ChartedMesh chart(const TriangleMesh& mesh, float texel_box, int largest_atlas = 4096);

} // namespace frustumscreen
