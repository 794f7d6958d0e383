#include "assets_baked/bake/cell_mesh.h"

#include <utility>

namespace frustumscreen::bake {

namespace {

/// In the box of the whole.
std::optional<SourceReduction> in_box(const std::optional<SourceReduction>& reduction, std::size_t triangles,
                                      std::size_t points, double units_per_box) {
    if (!reduction) {
        return std::nullopt;
    }
    return SourceReduction{.triangles = triangles,
                           .points = points,
                           .mean = reduction->mean / units_per_box,
                           .p95 = reduction->p95 / units_per_box,
                           .max = reduction->max / units_per_box};
}

} // namespace

CellMeshes::CellMeshes(const SourceMesh& mesh, const BoxFrame& frame,
                       std::span<const std::optional<std::size_t>> cell_of_triangle, std::size_t cells)
    : whole_(mesh), frame_(frame), points_(bake::in_box(mesh, frame)), triangles_(cells),
      vertex_of_(mesh.positions.size(), 0), made_for_(mesh.positions.size(), 0) {
    for (std::size_t t = 0; t < cell_of_triangle.size(); ++t) {
        if (cell_of_triangle[t]) {
            triangles_[*cell_of_triangle[t]].push_back(static_cast<std::uint32_t>(t));
        }
    }
}

SourceMesh CellMeshes::mesh_of(std::size_t cell) {
    const auto number = static_cast<std::uint32_t>(cell + 1);
    SourceMesh made;
    made.materials = whole_.materials;
    made.textures = whole_.textures;
    made.layers = whole_.layers;
    made.default_up = 'z';
    made.is_unlit = whole_.is_unlit;
    const auto vertex = [&](std::uint32_t from) {
        if (made_for_[from] != number) {
            made_for_[from] = number;
            vertex_of_[from] = static_cast<std::uint32_t>(made.positions.size());
            made.positions.push_back(points_[from]);
            if (!whole_.uvs.empty()) {
                made.uvs.push_back(whole_.uvs[from]);
            }
            if (!whole_.colours.empty()) {
                made.colours.push_back(whole_.colours[from]);
            }
            if (!whole_.normals.empty()) {
                made.normals.emplace_back(frame_.turned_from_file * glm::dvec3(whole_.normals[from]));
            }
        }
        return vertex_of_[from];
    };
    for (const std::uint32_t t : triangles_[cell]) {
        const auto& [a, b, c] = whole_.triangles[t];
        made.triangles.push_back({vertex(a), vertex(b), vertex(c)});
        made.triangle_materials.push_back(whole_.triangle_materials[t]);
    }
    made.reduced_from =
        in_box(whole_.reduced_from, made.triangles.size(), made.positions.size(), frame_.file_units_per_box);
    return made;
}

} // namespace frustumscreen::bake
