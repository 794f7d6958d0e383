/// Which chart each triangle of a mesh goes to: borders are short, because each place at one is a vertex more in every frame.
///
/// Method   charts grow from large triangles over neighbours that face the same way. Those of the first mesh then grow anew, some
///          times, each from the triangle where it began and along the mean of what it had taken (Lloyd's algorithm, as variational
///          shape approximation has it: Cohen-Steiner, Alliez & Desbrun 2004). Then triangles that stick out into another chart go
///          there.
/// Frames   box.
/// Threads  one caller; uses all cores. Deterministic.
#pragma once

#include "assets_baked/bake/chart.h"
#include "assets_baked/bake/triangle_mesh.h"

#include <cstdint>
#include <vector>

namespace frustumscreen {

inline constexpr std::uint32_t no_chart = 0xFFFFFFFFU;

class ChartFinder {
public:
    /// `number`: the mesh's own, from 1 on. `charts` gets new ones; `stray_box` and all of these as SharedCharts has them.
    ChartFinder(const TriangleMesh& mesh, std::uint32_t number, float texel_box, float stray_box,
                std::vector<Chart>& charts);

    /// Takes the charts that another mesh has at the same place, then those of the neighbours.
    void take_from(const TriangleMesh& other, const std::vector<std::uint32_t>& other_charts);

    /// Gives the rest new charts. Returns each triangle's; some charts may be left without any.
    [[nodiscard]] std::vector<std::uint32_t> find();

private:
    bool take(std::uint32_t chart, std::uint32_t triangle, float facing);
    void spread(std::vector<std::uint32_t> taken, float facing);
    [[nodiscard]] glm::vec3 direction_at(std::uint32_t seed) const;
    void grow_from(std::uint32_t seed, const glm::vec3& direction);
    void grow_the_rest();
    void grow_anew();
    void straighten_borders(float facing);
    [[nodiscard]] std::uint32_t chart_of_two_neighbours(std::uint32_t triangle) const;
    [[nodiscard]] std::vector<std::uint32_t> beside_in(const TriangleMesh& other) const;

    const TriangleMesh& mesh_;
    std::uint32_t number_;
    float texel_box_;
    float stray_box_;
    std::vector<Chart>& charts_;
    std::vector<std::uint32_t> across_; ///< of each corner: the triangle beyond the edge from it to the next
    std::vector<glm::vec3> vertex_normals_;
    std::vector<float> areas_;               ///< doubled
    std::vector<std::uint32_t> large_first_; ///< the triangles
    std::vector<std::uint32_t> chart_of_;
    std::vector<std::uint32_t> seeds_; ///< of the charts that this mesh began
};

} // namespace frustumscreen
