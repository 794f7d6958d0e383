#include "assets_baked/bake/winding.h"

#include <meshoptimizer.h>

#include <algorithm>
#include <array>
#include <numeric>
#include <tuple>

namespace frustumscreen::bake {

namespace {

struct Edge {
    std::uint32_t low = 0, high = 0; ///< numbers of its ends
    std::uint32_t opposite = 0;      ///< number of the triangle's third corner
    std::uint32_t triangle = 0;
    bool upward = false; ///< the triangle's corners run from low to high
};

/// Connected sets of triangles, each with the sides on which its triangles are (union-find with parity).
class FacingSets {
public:
    explicit FacingSets(std::size_t triangles) : parent_(triangles), flipped_(triangles, 0) {
        std::iota(parent_.begin(), parent_.end(), 0U);
    }
    struct Place {
        std::uint32_t set = 0;
        bool flipped = false; ///< relative to the set's first triangle
    };
    [[nodiscard]] Place find(std::uint32_t triangle) {
        std::uint32_t set = triangle;
        bool flipped = false;
        while (parent_[set] != set) {
            flipped = flipped != (flipped_[set] != 0);
            set = parent_[set];
        }
        bool left = flipped;
        while (parent_[triangle] != set && triangle != set) { // shortens the path
            const bool own = flipped_[triangle] != 0;
            const std::uint32_t next = parent_[triangle];
            parent_[triangle] = set;
            flipped_[triangle] = left ? 1 : 0;
            left = left != own;
            triangle = next;
        }
        return {set, flipped};
    }
    /// The first connection of two sets decides; a surface with one side, such as a Moebius strip, has others too.
    void connect(std::uint32_t a, std::uint32_t b, bool differ) {
        const Place at_a = find(a);
        const Place at_b = find(b);
        if (at_a.set != at_b.set) {
            parent_[at_b.set] = at_a.set;
            flipped_[at_b.set] = (at_a.flipped != at_b.flipped) != differ ? 1 : 0;
        }
    }

private:
    std::vector<std::uint32_t> parent_;
    std::vector<std::uint8_t> flipped_; ///< relative to the parent
};

std::vector<Edge> sorted_edges(const SourceMesh& mesh) {
    const std::vector<std::uint32_t> place = numbers_of_places(mesh);
    std::vector<Edge> edges;
    edges.reserve(3 * mesh.triangles.size());
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t a = place[mesh.triangles[t][k]];
            const std::uint32_t b = place[mesh.triangles[t][(k + 1) % 3]];
            const std::uint32_t c = place[mesh.triangles[t][(k + 2) % 3]];
            if (a != b) {
                edges.push_back({.low = std::min(a, b),
                                 .high = std::max(a, b),
                                 .opposite = c,
                                 .triangle = t,
                                 .upward = a < b});
            }
        }
    }
    std::sort(edges.begin(), edges.end(), [](const Edge& a, const Edge& b) {
        return std::tie(a.low, a.high, a.triangle) < std::tie(b.low, b.high, b.triangle);
    });
    return edges;
}

double area_of(const SourceMesh& mesh, std::size_t triangle) {
    const auto& [a, b, c] = mesh.triangles[triangle];
    return 0.5 * glm::length(glm::cross(mesh.positions[b] - mesh.positions[a],
                                        mesh.positions[c] - mesh.positions[a]));
}

} // namespace

std::vector<std::uint32_t> numbers_of_places(const SourceMesh& mesh) {
    std::vector<std::uint32_t> numbers(mesh.positions.size());
    meshopt_generateVertexRemap(numbers.data(), nullptr, mesh.positions.size(), mesh.positions.data(),
                                mesh.positions.size(), sizeof(glm::dvec3));
    return numbers;
}

double inside_out_share(const SourceMesh& mesh) {
    FacingSets sets(mesh.triangles.size());
    const std::vector<Edge> edges = sorted_edges(mesh);
    for (std::size_t begin = 0, end = 0; begin < edges.size(); begin = end) {
        while (end < edges.size() && edges[end].low == edges[begin].low &&
               edges[end].high == edges[begin].high) {
            ++end;
        }
        const Edge& a = edges[begin];
        const Edge& b = edges[end - 1];
        if (end - begin == 2 && a.opposite != b.opposite) { // two triangles at one place are no neighbours
            // Neighbours that run alike pass their edge in opposite directions.
            sets.connect(a.triangle, b.triangle, a.upward == b.upward);
        }
    }
    std::vector<std::array<double, 2>> areas(mesh.triangles.size());
    double all = 0.0;
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
        const FacingSets::Place place = sets.find(t);
        const double area = area_of(mesh, t);
        areas[place.set][place.flipped ? 1 : 0] += area;
        all += area;
    }
    double inside_out = 0.0;
    for (const std::array<double, 2>& area : areas) {
        inside_out += std::min(area[0], area[1]);
    }
    return all > 0.0 ? inside_out / all : 0.0;
}

} // namespace frustumscreen::bake
