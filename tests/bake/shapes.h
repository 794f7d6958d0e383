/// Small shapes with known geometry, as sources for the bake's tests.
#pragma once

#include "assets_baked/bake/source_mesh.h"

#include <cmath>
#include <numbers>
#include <random>

namespace frustumscreen::test {

inline bake::SourceMesh empty_mesh() {
    bake::SourceMesh mesh;
    mesh.materials.resize(1);
    return mesh;
}

inline void add_triangle(bake::SourceMesh& mesh, std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    mesh.triangles.push_back({a, b, c});
    mesh.triangle_materials.push_back(0);
}

/// A sphere of `rows` x 2 `rows` quads about `centre`; outward.
inline void add_sphere(bake::SourceMesh& mesh, const glm::dvec3& centre, double radius, int rows) {
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    const int columns = 2 * rows;
    for (int j = 0; j <= rows; ++j) {
        const double polar = std::numbers::pi * j / rows;
        for (int i = 0; i < columns; ++i) {
            const double azimuth = 2.0 * std::numbers::pi * i / columns;
            const double ring = j == 0 || j == rows ? 0.0 : std::sin(polar);
            mesh.positions.push_back(centre + radius * glm::dvec3(ring * std::cos(azimuth),
                                                                  ring * std::sin(azimuth), std::cos(polar)));
        }
    }
    const auto at = [&](int j, int i) {
        return first + static_cast<std::uint32_t>(j * columns + i % columns);
    };
    for (int j = 0; j < rows; ++j) {
        for (int i = 0; i < columns; ++i) {
            add_triangle(mesh, at(j, i), at(j + 1, i), at(j + 1, i + 1));
            add_triangle(mesh, at(j, i), at(j + 1, i + 1), at(j, i + 1));
        }
    }
}

/// An axis-aligned box from `low` to `high`; outward.
inline void add_box(bake::SourceMesh& mesh, const glm::dvec3& low, const glm::dvec3& high) {
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    for (int k = 0; k < 8; ++k) {
        mesh.positions.emplace_back((k & 1) != 0 ? high.x : low.x, (k & 2) != 0 ? high.y : low.y,
                                    (k & 4) != 0 ? high.z : low.z);
    }
    const auto quad = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
        add_triangle(mesh, first + a, first + b, first + c);
        add_triangle(mesh, first + a, first + c, first + d);
    };
    quad(1, 3, 7, 5); // +x
    quad(2, 0, 4, 6); // -x
    quad(3, 2, 6, 7); // +y
    quad(0, 1, 5, 4); // -y
    quad(4, 5, 7, 6); // +z
    quad(0, 2, 3, 1); // -z
}

} // namespace frustumscreen::test
