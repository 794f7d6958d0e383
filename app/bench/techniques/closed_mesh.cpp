#include "app/bench/techniques/closed_mesh.h"

#include <algorithm>
#include <limits>
#include <unordered_map>
#include <utility>

namespace frustumscreen::bench {

namespace {

using Cell = std::array<std::int64_t, 3>;

struct CellHash {
    std::size_t operator()(const Cell& cell) const {
        std::uint64_t hash = 0;
        for (const std::int64_t coordinate : cell) {
            hash = (hash ^ static_cast<std::uint64_t>(coordinate)) * 0x9E3779B97F4A7C15ULL;
            hash ^= hash >> 29U;
        }
        return hash;
    }
};

/// Gives one number to all vertices in one cell of a grid of 1e-6 of the size.
std::vector<std::uint32_t> welded(const std::vector<glm::dvec3>& positions, const glm::dvec3& low,
                                  double size) {
    std::unordered_map<Cell, std::uint32_t, CellHash> cells;
    cells.reserve(positions.size());
    std::vector<std::uint32_t> numbers;
    numbers.reserve(positions.size());
    for (const glm::dvec3& position : positions) {
        const glm::dvec3 scaled = (position - low) / size * 1e6 + 0.5;
        const Cell cell{static_cast<std::int64_t>(scaled.x), static_cast<std::int64_t>(scaled.y),
                        static_cast<std::int64_t>(scaled.z)};
        numbers.push_back(cells.emplace(cell, static_cast<std::uint32_t>(cells.size())).first->second);
    }
    return numbers;
}

} // namespace

bool is_closed(const bake::SourceMesh& mesh) {
    glm::dvec3 low(std::numeric_limits<double>::infinity());
    glm::dvec3 high(-std::numeric_limits<double>::infinity());
    for (const glm::dvec3& position : mesh.positions) {
        low = glm::min(low, position);
        high = glm::max(high, position);
    }
    const bool masked = std::any_of(mesh.materials.begin(), mesh.materials.end(),
                                    [](const bake::SourceMaterial& material) { return material.alpha_mask; });
    const double size = glm::distance(low, high);
    if (masked || !(size > 0.0)) {
        return false;
    }
    const std::vector<std::uint32_t> numbers = welded(mesh.positions, low, size);
    std::vector<std::pair<std::uint32_t, std::uint32_t>> there;
    std::vector<std::pair<std::uint32_t, std::uint32_t>> back;
    double volume = 0.0;
    for (const std::array<std::uint32_t, 3>& triangle : mesh.triangles) {
        volume += glm::dot(mesh.positions[triangle[0]] - low,
                           glm::cross(mesh.positions[triangle[1]] - low, mesh.positions[triangle[2]] - low));
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t from = numbers[triangle[k]];
            const std::uint32_t to = numbers[triangle[(k + 1) % 3]];
            if (from != to) {
                there.emplace_back(from, to);
                back.emplace_back(to, from);
            }
        }
    }
    std::sort(there.begin(), there.end());
    std::sort(back.begin(), back.end());
    return volume > 0.0 && there == back;
}

} // namespace frustumscreen::bench
