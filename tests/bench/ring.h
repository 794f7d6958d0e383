/// An artifact for the bench's tests.
#pragma once

#include "assets_baked/bake/source_mesh.h"

#include <cmath>
#include <memory>
#include <numbers>

namespace frustumscreen::bench {

/// The ring's radii and the height of its middle above the table, metres.
inline constexpr double ring_major_m = 0.030, ring_minor_m = 0.010, ring_middle_m = 0.045;

/// A closed, concave object: a ring (torus) standing in the prop, with a smooth texture.
inline std::shared_ptr<bake::SourceMesh> ring() {
    constexpr std::uint32_t around = 96;
    constexpr std::uint32_t across = 32;
    auto mesh = std::make_shared<bake::SourceMesh>();
    auto image = std::make_shared<image::Image8>(256, 256);
    for (int y = 0; y < 256; ++y) {
        for (int x = 0; x < 256; ++x) {
            const double wave = 127.5 + 100.0 * std::sin(2.0 * std::numbers::pi * x / 256.0);
            image->at(x, y) = {static_cast<std::uint8_t>(wave), 128, 200, 255};
        }
    }
    mesh->textures = {{image, bake::Wrap::Repeat, bake::Wrap::Repeat}};
    mesh->materials = {{glm::vec4(1.0F), 0, false, 0.5F}};
    for (std::uint32_t j = 0; j <= around; ++j) {
        for (std::uint32_t i = 0; i <= across; ++i) {
            const double a = 2.0 * std::numbers::pi * j / around;
            const double b = 2.0 * std::numbers::pi * i / across;
            const double r = ring_major_m + ring_minor_m * std::cos(b);
            mesh->positions.emplace_back(r * std::cos(a), ring_minor_m * std::sin(b),
                                         ring_middle_m + r * std::sin(a));
            mesh->uvs.emplace_back(static_cast<float>(j) / around, static_cast<float>(i) / across);
        }
    }
    for (std::uint32_t j = 0; j < around; ++j) {
        for (std::uint32_t i = 0; i < across; ++i) {
            const std::uint32_t k = j * (across + 1) + i;
            mesh->triangles.push_back({k, k + 1, k + across + 1});
            mesh->triangles.push_back({k + 1, k + across + 2, k + across + 1});
        }
    }
    mesh->triangle_materials.assign(mesh->triangles.size(), 0);
    return mesh;
}

} // namespace frustumscreen::bench
