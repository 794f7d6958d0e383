/// Cuts surfaces into charts that each have one orthographic projection without overlap, and lays them out in
/// one atlas. A chart's map is linear in position, so moving a vertex along its surface never distorts the
/// colour. All levels of an artifact use the same charts where their triangles fit, and one texture serves
/// them all.
///
/// Frames   positions in the box frame; uv in texels of the atlas (texel centres at 0.5).
/// Threads  one caller; `add` uses all cores. Deterministic.
#pragma once

#include "assets_baked/bake/chart.h"
#include "assets_baked/bake/triangle_mesh.h"

#include <glm/glm.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace frustumscreen::bake {

struct ChartedMesh {
    int atlas_width = 0;
    int atlas_height = 0;
    std::vector<glm::vec3> positions; ///< split at chart borders; equal positions stay bit-equal
    std::vector<glm::vec3>
        normals; ///< unit, one each index: smooth across chart borders, not across hard edges
    std::vector<glm::vec2> uv_texels;
    std::vector<std::uint32_t> indices;
    std::size_t chart_count = 0; ///< of the whole atlas; some may have become empty
};

/// Texels of padding on every side of a chart.
inline constexpr int chart_gutter_texels = 3;

class SharedCharts {
public:
    /// `texel_box` is the edge of a texel in box units; it grows while the atlas would exceed `largest_atlas`
    /// texels a side, unless the gutters alone exceed it.
    SharedCharts(float texel_box, int largest_atlas) : texel_box_(texel_box), largest_atlas_(largest_atlas) {}

    /// Gives each triangle of `mesh` a chart: an existing one that shows the same surface, otherwise a new
    /// one. Add coarse meshes first, because large triangles make large charts, which small ones fit into.
    /// `stray_box`: largest distance of the mesh from the previous one. A triangle without area and without
    /// neighbours is left out.
    void add(const TriangleMesh& mesh, float stray_box);

    /// The meshes in the order of their addition, on one atlas.
    [[nodiscard]] std::vector<ChartedMesh> lay_out() const;

private:
    struct Added {
        TriangleMesh mesh;
        std::vector<std::uint32_t> chart_of; ///< of each triangle
    };

    float texel_box_;
    int largest_atlas_;
    std::vector<Chart> charts_;
    std::vector<Added> added_;
};

/// The charts of a single mesh.
[[nodiscard]] ChartedMesh chart(const TriangleMesh& mesh, float texel_box, int largest_atlas = 4096);

/// The triangles of all meshes, which must share an atlas, in order.
[[nodiscard]] ChartedMesh joined(std::span<const ChartedMesh> meshes);

} // namespace frustumscreen::bake
