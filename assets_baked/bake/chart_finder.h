/// Assigns each triangle of a mesh to a chart. Borders are kept short, because each vertex on a border is
/// duplicated in every frame.
///
/// Method   charts grow from large triangles over neighbours that face the same way. Those of the first mesh
///          then grow again, several times, each from the triangle where it began and along the mean of the
///          normals that it had taken (Lloyd's algorithm, as in variational shape approximation:
///          Cohen-Steiner, Alliez & Desbrun 2004). Finally triangles that stick out into another chart are
///          moved there.
/// Frames   box.
/// Threads  one caller; uses all cores. Deterministic.
#pragma once

#include "assets_baked/bake/chart.h"
#include "assets_baked/bake/triangle_mesh.h"

#include <cstdint>
#include <vector>

namespace frustumscreen::bake {

inline constexpr std::uint32_t no_chart = 0xFFFFFFFFU;

class ChartFinder {
public:
    /// `number`: the mesh's own, from 1. New charts are added to `charts`; the other parameters as in
    /// SharedCharts.
    ChartFinder(const TriangleMesh& mesh, std::uint32_t number, float texel_box, float stray_box,
                std::vector<Chart>& charts);

    /// Takes the charts of another mesh at the same positions, then those of the neighbours.
    void take_from(const TriangleMesh& other, const std::vector<std::uint32_t>& other_charts);

    /// Gives the remaining triangles new charts. Returns the chart of each triangle; some charts may become
    /// empty.
    [[nodiscard]] std::vector<std::uint32_t> find();

private:
    bool take(std::uint32_t chart, std::uint32_t triangle, float facing);
    void spread(std::vector<std::uint32_t> taken, float facing);
    [[nodiscard]] glm::vec3 direction_at(std::uint32_t seed) const;
    void grow_from(std::uint32_t seed, const glm::vec3& direction);
    void grow_others();
    void regrow();
    void straighten_borders(float facing);
    [[nodiscard]] std::uint32_t chart_of_two_neighbours(std::uint32_t triangle) const;
    [[nodiscard]] std::vector<std::uint32_t> beside_in(const TriangleMesh& other) const;

    const TriangleMesh& mesh_;
    std::uint32_t number_;
    float texel_box_;
    float stray_box_;
    std::vector<Chart>& charts_;
    std::vector<std::uint32_t> across_; ///< of each corner: the triangle beyond the edge to the next corner
    std::vector<glm::vec3> vertex_normals_;
    std::vector<float> areas_;               ///< doubled
    std::vector<std::uint32_t> large_first_; ///< triangles by falling area
    std::vector<std::uint32_t> chart_of_;
    std::vector<std::uint32_t> seeds_; ///< of the charts that this mesh began
};

} // namespace frustumscreen::bake
