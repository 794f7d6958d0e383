#include "assets_baked/bake/sheet_ends.h"

#include <algorithm>
#include <array>
#include <numeric>

namespace frustumscreen::bake {

namespace {

struct Edge {
    std::uint32_t low = 0, high = 0; ///< position numbers of its ends
    std::uint32_t triangle = 0;
    int corner = 0; ///< opposite the edge
};

/// A number for each vertex, equal for vertices at the same point: files split vertices at seams of the
/// texture.
std::vector<std::uint32_t> places_of(const SourceScene& surface) {
    const std::vector<std::array<std::uint32_t, 3>>& triangles = surface.mesh().triangles;
    std::vector<std::uint32_t> order(3 * triangles.size());
    std::iota(order.begin(), order.end(), 0U);
    const auto point = [&](std::uint32_t k) -> const glm::vec3& {
        return surface.corner(k / 3, static_cast<int>(k % 3));
    };
    const auto before = [&](std::uint32_t a, std::uint32_t b) {
        const glm::vec3& p = point(a);
        const glm::vec3& q = point(b);
        return p.x != q.x ? p.x < q.x : p.y != q.y ? p.y < q.y : p.z < q.z;
    };
    std::sort(order.begin(), order.end(), before);
    std::vector<std::uint32_t> places(order.size());
    for (std::size_t k = 0; k < order.size(); ++k) {
        const bool same = k > 0 && point(order[k]) == point(order[k - 1]);
        places[order[k]] = same ? places[order[k - 1]] : static_cast<std::uint32_t>(k);
    }
    return places;
}

class EndsOfDirection {
public:
    EndsOfDirection(const BlockInput& input, const relief::ReliefGrid& grid) : input_(input), grid_(grid) {}

    std::vector<relief::SheetEnd> find() {
        const std::vector<Edge> edges = facing_edges();
        for (std::size_t k = 0; k < edges.size();) {
            std::size_t end = k + 1;
            while (end < edges.size() && edges[end].low == edges[k].low && edges[end].high == edges[k].high) {
                ++end;
            }
            if (end == k + 1) {
                follow(edges[k]);
            }
            k = end;
        }
        std::stable_sort(
            ends_.begin(), ends_.end(),
            [](const relief::SheetEnd& a, const relief::SheetEnd& b) { return a.cell() < b.cell(); });
        return std::move(ends_);
    }

private:
    [[nodiscard]] SurfaceHit seen(std::uint32_t triangle) const {
        SurfaceHit hit;
        const glm::vec3& a = input_.surface.corner(triangle, 0);
        const glm::vec3 normal =
            glm::cross(input_.surface.corner(triangle, 1) - a, input_.surface.corner(triangle, 2) - a);
        const float length = glm::length(normal);
        hit.hit = length > 0.0F;
        hit.triangle = triangle;
        hit.normal = hit.hit ? normal / length : glm::vec3(0.0F);
        return hit;
    }

    [[nodiscard]] std::vector<Edge> facing_edges() const {
        const std::vector<std::uint32_t> places = places_of(input_.surface);
        std::vector<Edge> edges;
        for (std::uint32_t triangle = 0; triangle < places.size() / 3; ++triangle) {
            if (!crossing_from(input_, grid_, seen(triangle))) {
                continue;
            }
            for (std::uint32_t corner = 0; corner < 3; ++corner) {
                const std::uint32_t from = places[3 * triangle + (corner + 1) % 3];
                const std::uint32_t to = places[3 * triangle + (corner + 2) % 3];
                edges.push_back({.low = std::min(from, to),
                                 .high = std::max(from, to),
                                 .triangle = triangle,
                                 .corner = static_cast<int>(corner)});
            }
        }
        std::sort(edges.begin(), edges.end(), [](const Edge& a, const Edge& b) {
            return std::pair(a.low, a.high) < std::pair(b.low, b.high);
        });
        return edges;
    }

    void follow(const Edge& edge) {
        constexpr float apart = 0.25F;  // texels
        constexpr float inside = 0.02F; // texels from the edge, and at most this share of the triangle
        const auto texels = static_cast<float>(input_.texels);
        const glm::vec3& from = input_.surface.corner(edge.triangle, (edge.corner + 1) % 3);
        const glm::vec3& to = input_.surface.corner(edge.triangle, (edge.corner + 2) % 3);
        const glm::vec3& opposite = input_.surface.corner(edge.triangle, edge.corner);
        const int count = 1 + static_cast<int>(glm::distance(from, to) * texels / apart);
        const float in = std::min(0.3F, inside / (texels * glm::distance(0.5F * (from + to), opposite)));
        SurfaceHit hit = seen(edge.triangle);
        for (int k = 0; k < count; ++k) {
            const float along = (static_cast<float>(k) + 0.5F) / static_cast<float>(count);
            std::array<float, 3> weights{};
            weights[static_cast<std::size_t>(edge.corner)] = in;
            weights[static_cast<std::size_t>((edge.corner + 1) % 3)] = (1.0F - in) * (1.0F - along);
            weights[static_cast<std::size_t>((edge.corner + 2) % 3)] = (1.0F - in) * along;
            hit.u = weights[1];
            hit.v = weights[2];
            hit.point = (1.0F - in) * (from + along * (to - from)) + in * opposite;
            const std::optional<relief::Crossing> crossing = crossing_from(input_, grid_, hit);
            if (crossing && crossing->own) {
                const glm::dvec3 at = relief::grid_from_box(grid_, hit.point, 1.0 / input_.texels);
                ends_.push_back({*crossing, static_cast<float>(at.x), static_cast<float>(at.y)});
            }
        }
    }

    const BlockInput& input_;
    const relief::ReliefGrid& grid_;
    std::vector<relief::SheetEnd> ends_;
};

} // namespace

std::vector<relief::SheetEnd> sheet_ends(const BlockInput& input, const relief::ReliefGrid& grid) {
    return EndsOfDirection(input, grid).find();
}

} // namespace frustumscreen::bake
