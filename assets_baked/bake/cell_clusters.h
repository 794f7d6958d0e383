/// A scan's vertices, gathered in the cells of a grid: one point stands for those of a cell (Lindstrom, Out-of-core
/// simplification of large polygonal models, 2000).
///
/// Attributes  the mean of a cell's vertices, for each chart of texture coordinates alone; so charts never mix.
/// Memory      for each vertex of the scan 4 bytes, 12 where it has texture coordinates; for each cell about 120.
/// Threads     one; the scan's order decides on the result's order.
/// Library     meshoptimizer (equal vertices).
#pragma once

#include "assets_baked/bake/cell_numbers.h"
#include "assets_baked/bake/cell_quadric.h"
#include "assets_baked/bake/source_mesh.h"

#include <glm/glm.hpp>

#include <cstdint>
#include <vector>

namespace frustumscreen {

class CellClusters {
public:
    /// `mesh` must outlive this. `low`: of the vertices that triangles use. `cell`: the length of a cell's edge, at
    /// least a `max_cells_along`th of the scan's.
    CellClusters(const SourceMesh& mesh, const glm::dvec3& low, double cell);

    /// The scan with a vertex for each cell. Triangles within two cells vanish, except those of parts that are too small
    /// or thin for the cells and would vanish with them. Has positions, attributes and triangles alone.
    [[nodiscard]] SourceMesh reduced() const;

private:
    /// The vertices of one cell and chart.
    struct Part {
        std::uint32_t cluster = 0;
        float count = 0.0F;
    };
    class Output;

    [[nodiscard]] glm::dvec3 in_cells(std::uint32_t vertex) const;
    void add_vertex(std::uint32_t vertex, std::uint32_t chart);
    void add_triangle(std::size_t triangle);
    [[nodiscard]] bool spans_cells(std::size_t triangle) const;
    [[nodiscard]] std::uint32_t cluster_of(std::uint32_t vertex) const {
        return parts_[part_of_[vertex]].cluster;
    }
    /// For each cell, whether a triangle of the result has a corner there.
    [[nodiscard]] std::vector<bool> reached() const;

    const SourceMesh& mesh_;
    glm::dvec3 low_;
    double cell_;
    CellNumbers cells_;
    std::vector<glm::i32vec3> cell_of_cluster_;
    std::vector<CellQuadric> clusters_;
    CellNumbers part_numbers_;
    std::vector<Part> parts_;
    std::vector<std::uint32_t>
        part_of_;                    ///< of each vertex; `CellNumbers::none` for one that no triangle uses
    std::vector<glm::vec2> uv_sums_; ///< of each part; empty where the scan has none
    std::vector<glm::vec4> colour_sums_;
    std::vector<glm::vec3> normal_sums_;
};

} // namespace frustumscreen
