#include "app/bench/stability/shapes.h"

#include <cmath>
#include <numbers>

namespace frustumscreen::bench {

namespace {

bake::SourceMesh without_triangles() {
    bake::SourceMesh mesh;
    mesh.materials.resize(1);
    mesh.default_up = 'z';
    return mesh;
}

} // namespace

void add_triangle(bake::SourceMesh& mesh, const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    mesh.positions.insert(mesh.positions.end(), {a, b, c});
    mesh.triangles.push_back({first, first + 1, first + 2});
    mesh.triangle_materials.push_back(0);
}

bake::SourceMesh sphere(const glm::dvec3& centre, double radius, int rows) {
    bake::SourceMesh mesh = without_triangles();
    const int columns = 2 * rows;
    const auto at = [&](int row, int column) {
        const double polar = std::numbers::pi * row / rows;
        const double azimuth = 2.0 * std::numbers::pi * (column % columns) / columns;
        const double ring = row == 0 || row == rows ? 0.0 : std::sin(polar);
        return centre +
               radius * glm::dvec3(ring * std::cos(azimuth), ring * std::sin(azimuth), std::cos(polar));
    };
    for (int row = 0; row < rows; ++row) {
        for (int column = 0; column < columns; ++column) {
            if (row + 1 < rows) {
                add_triangle(mesh, at(row, column), at(row + 1, column), at(row + 1, column + 1));
            }
            if (row > 0) {
                add_triangle(mesh, at(row, column), at(row + 1, column + 1), at(row, column + 1));
            }
        }
    }
    return mesh;
}

bake::SourceMesh box_mesh(const glm::dvec3& size) {
    bake::SourceMesh mesh = without_triangles();
    const auto corner = [&](int k) {
        return size * glm::dvec3((k & 1) - 0.5, ((k >> 1) & 1) - 0.5, (k >> 2) & 1);
    };
    constexpr int quads[6][4] = {{1, 3, 7, 5}, {2, 0, 4, 6}, {3, 2, 6, 7},
                                 {0, 1, 5, 4}, {4, 5, 7, 6}, {0, 2, 3, 1}};
    for (const auto& quad : quads) {
        add_triangle(mesh, corner(quad[0]), corner(quad[1]), corner(quad[2]));
        add_triangle(mesh, corner(quad[0]), corner(quad[2]), corner(quad[3]));
    }
    return mesh;
}

} // namespace frustumscreen::bench
