#include "assets_baked/bake/winding.h"

#include <meshoptimizer.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <numeric>
#include <tuple>
#include <utility>

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
            if (a == b || b == c || c == a) {
                break; // a triangle without area has no sides
            }
            edges.push_back({.low = std::min(a, b),
                             .high = std::max(a, b),
                             .opposite = c,
                             .triangle = t,
                             .upward = a < b});
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

namespace {

/// Calls `pair` for each edge of two triangles that are neighbours, and `other` for each triangle at another edge.
template <typename Pair, typename Other>
void for_each_edge(const std::vector<Edge>& edges, const Pair& pair, const Other& other) {
    for (std::size_t begin = 0, end = 0; begin < edges.size(); begin = end) {
        while (end < edges.size() && edges[end].low == edges[begin].low &&
               edges[end].high == edges[begin].high) {
            ++end;
        }
        const Edge& a = edges[begin];
        const Edge& b = edges[end - 1];
        if (end - begin == 2 && a.opposite != b.opposite) { // two triangles at one place are no neighbours
            pair(a, b);
            continue;
        }
        for (std::size_t k = begin; k < end; ++k) {
            other(edges[k].triangle);
        }
    }
}

/// Neighbours that run alike pass their edge in opposite directions.
bool run_differently(const Edge& a, const Edge& b) {
    return a.upward == b.upward;
}

FacingSets facing_sets(const SourceMesh& mesh, const std::vector<Edge>& edges) {
    FacingSets sets(mesh.triangles.size());
    for_each_edge(
        edges,
        [&](const Edge& a, const Edge& b) { sets.connect(a.triangle, b.triangle, run_differently(a, b)); },
        [](std::uint32_t) {});
    return sets;
}

/// A connected set of triangles, as its first triangle runs.
struct FacingPart {
    bool closed = true; ///< each edge has two triangles, and the part has two sides
    double volume = 0.0;
    std::array<double, 2> areas{}; ///< of the triangles that run like the first one, and of the others
    glm::dvec3 low{std::numeric_limits<double>::infinity()};
    glm::dvec3 high{-std::numeric_limits<double>::infinity()};

    [[nodiscard]] bool contains(const FacingPart& other) const {
        return glm::all(glm::lessThan(low, other.low)) && glm::all(glm::lessThan(other.high, high));
    }
    [[nodiscard]] double box() const {
        const glm::dvec3 edges = high - low;
        return edges.x * edges.y * edges.z;
    }
};

/// By the number of a set; the others are empty.
std::vector<FacingPart> facing_parts(const SourceMesh& mesh, const std::vector<Edge>& edges,
                                     FacingSets& sets) {
    std::vector<FacingPart> parts(mesh.triangles.size());
    const glm::dvec3 middle = mesh.positions[mesh.triangles.front()[0]]; // near the artifact
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
        const FacingSets::Place place = sets.find(t);
        FacingPart& part = parts[place.set];
        const auto& [a, b, c] = mesh.triangles[t];
        part.areas[place.flipped ? 1 : 0] += area_of(mesh, t);
        part.volume += (place.flipped ? -1.0 : 1.0) / 6.0 *
                       glm::dot(mesh.positions[a] - middle,
                                glm::cross(mesh.positions[b] - middle, mesh.positions[c] - middle));
        for (const std::uint32_t vertex : {a, b, c}) {
            part.low = glm::min(part.low, mesh.positions[vertex]);
            part.high = glm::max(part.high, mesh.positions[vertex]);
        }
    }
    for_each_edge(
        edges,
        [&](const Edge& a, const Edge& b) {
            const FacingSets::Place at_a = sets.find(a.triangle);
            const bool agree = (at_a.flipped != sets.find(b.triangle).flipped) == run_differently(a, b);
            parts[at_a.set].closed = parts[at_a.set].closed && agree;
        },
        [&](std::uint32_t triangle) { parts[sets.find(triangle).set].closed = false; });
    return parts;
}

/// The closed parts with the largest extents, in which others may lie.
std::vector<FacingPart> largest_closed(const std::vector<FacingPart>& parts) {
    constexpr std::size_t most = 32;
    std::vector<FacingPart> largest;
    std::copy_if(parts.begin(), parts.end(), std::back_inserter(largest),
                 [](const FacingPart& part) { return part.closed && part.volume != 0.0; });
    std::sort(largest.begin(), largest.end(),
              [](const FacingPart& a, const FacingPart& b) { return a.box() > b.box(); });
    largest.resize(std::min(largest.size(), most));
    return largest;
}

/// True if the triangles that run like the part's first one are inside out.
bool is_inside_out(const FacingPart& part, const std::vector<FacingPart>& around) {
    constexpr double flat = 1e-6; // of the volume of a cube with that area
    const double area = part.areas[0] + part.areas[1];
    const bool is_flat = std::abs(part.volume) < flat * std::pow(area / 6.0, 1.5);
    const bool may_be_hollow = std::any_of(around.begin(), around.end(),
                                           [&](const FacingPart& each) { return each.contains(part); });
    return is_flat || may_be_hollow ? part.areas[1] > part.areas[0] : part.volume < 0.0;
}

} // namespace

double inside_out_share(const SourceMesh& mesh) {
    FacingSets sets = facing_sets(mesh, sorted_edges(mesh));
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

std::size_t turn_outward(SourceMesh& mesh) {
    if (mesh.triangles.empty()) {
        return 0;
    }
    const std::vector<Edge> edges = sorted_edges(mesh);
    FacingSets sets = facing_sets(mesh, edges);
    const std::vector<FacingPart> parts = facing_parts(mesh, edges, sets);
    const std::vector<FacingPart> around = largest_closed(parts);
    std::vector<std::uint8_t> first_is_wrong(parts.size(), 0);
    for (std::size_t k = 0; k < parts.size(); ++k) {
        first_is_wrong[k] = parts[k].closed && is_inside_out(parts[k], around) ? 1 : 0;
    }
    std::size_t turned = 0;
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
        const FacingSets::Place place = sets.find(t);
        if (parts[place.set].closed && area_of(mesh, t) > 0.0 &&
            place.flipped != (first_is_wrong[place.set] != 0)) {
            std::swap(mesh.triangles[t][1], mesh.triangles[t][2]);
            ++turned;
        }
    }
    return turned;
}

} // namespace frustumscreen::bake
