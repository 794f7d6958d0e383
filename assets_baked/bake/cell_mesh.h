/// The triangles of some nodes as a mesh of their own.
///
/// Frame    the whole artifact's box, z up.
/// Threads  one caller.
#pragma once

#include "assets_baked/bake/box_frame.h"
#include "assets_baked/bake/source_mesh.h"

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace frustumscreen::bake {

class CellMeshes {
public:
    /// `cell_of_triangle`: one for each triangle of `mesh`; none: in no cell.
    CellMeshes(const SourceMesh& mesh, const BoxFrame& frame,
               std::span<const std::optional<std::size_t>> cell_of_triangle, std::size_t cells);

    [[nodiscard]] std::size_t triangles_of(std::size_t cell) const { return triangles_[cell].size(); }
    /// Positions of the whole, in its box.
    [[nodiscard]] const std::vector<glm::dvec3>& points() const { return points_; }
    /// With the vertices that the cell uses. Materials and pictures are the whole's.
    [[nodiscard]] SourceMesh mesh_of(std::size_t cell);

private:
    const SourceMesh& whole_;
    const BoxFrame& frame_;
    std::vector<glm::dvec3> points_; ///< of the whole, in its box
    std::vector<std::vector<std::uint32_t>> triangles_;
    std::vector<std::uint32_t> vertex_of_; ///< of the cell, valid where `made_for_` is the cell's number + 1
    std::vector<std::uint32_t> made_for_;
};

} // namespace frustumscreen::bake
