#include "assets_baked/bake/site_curtains.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <numbers>
#include <tuple>
#include <unordered_map>
#include <utility>

namespace frustumscreen::bake {

namespace {

constexpr double squares = 16.0;        ///< along the box's longer side, at most (site_regions.h)
constexpr double on_cut_box = 1e-7;     ///< a corner this near to a cut lies on it
constexpr double below_box = 1e-2;      ///< how far a curtain hangs past the region's lowest place
constexpr double off_edge_share = 1e-3; ///< of the way from an edge to its triangle's third corner
constexpr float off_surface_box = 2e-5F;
constexpr float min_below_box = 2e-3F, max_below_box = 0.1F; ///< of the space below an edge

struct Edge {
    std::uint32_t a = 0, b = 0, across = 0; ///< vertices; `across`: the triangle's third one
    int triangles = 0;
};

/// The edges of one triangle alone, by the places of their ends.
std::vector<Edge> open_edges(const SourceMesh& region) {
    std::map<std::tuple<double, double, double>, std::uint32_t> numbers;
    std::vector<std::uint32_t> place(region.positions.size());
    for (std::size_t v = 0; v < place.size(); ++v) {
        const glm::dvec3& p = region.positions[v];
        place[v] = numbers.try_emplace({p.x, p.y, p.z}, static_cast<std::uint32_t>(v)).first->second;
    }
    std::unordered_map<std::uint64_t, std::size_t> known;
    std::vector<Edge> edges;
    for (const std::array<std::uint32_t, 3>& triangle : region.triangles) {
        for (std::size_t c = 0; c < 3; ++c) {
            const std::uint32_t a = place[triangle[c]];
            const std::uint32_t b = place[triangle[(c + 1) % 3]];
            const std::uint64_t key = std::uint64_t{std::min(a, b)} << 32U | std::max(a, b);
            const auto [found, is_new] = known.try_emplace(key, edges.size());
            if (is_new) {
                edges.push_back({a, b, place[triangle[(c + 2) % 3]], 0});
            }
            ++edges[found->second].triangles;
        }
    }
    std::erase_if(edges, [](const Edge& edge) { return edge.triangles != 1; });
    return edges;
}

/// True if both ends lie on one line that may be a cut, inside the site.
bool on_cut(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec2& half_ground) {
    for (int axis = 0; axis < 2; ++axis) {
        const double line = std::round((a[axis] + 0.5) * squares) / squares - 0.5;
        if (std::abs(a[axis] - line) < on_cut_box && std::abs(b[axis] - line) < on_cut_box &&
            std::abs(line) < half_ground[axis] - on_cut_box) {
            return true;
        }
    }
    return false;
}

/// True if rays from half way down to the next surface below leave the site upwards.
bool open_below(const glm::vec3& at, const SourceScene& whole) {
    const SurfaceHit floor = whole.trace(at, glm::vec3(0.0F, 0.0F, -1.0F), off_surface_box);
    const float space = std::clamp(floor.hit ? floor.distance : max_below_box, min_below_box, max_below_box);
    const glm::vec3 from = at - glm::vec3(0.0F, 0.0F, 0.5F * space);
    constexpr int azimuths = 8;
    constexpr float far_box = 4.0F;
    for (int k = 0; k < azimuths; ++k) {
        const double azimuth = 2.0 * std::numbers::pi * (k + 0.5) / azimuths;
        for (const double elevation : {std::numbers::pi / 6.0, std::numbers::pi / 3.0}) {
            const glm::vec3 towards(std::cos(azimuth) * std::cos(elevation),
                                    std::sin(azimuth) * std::cos(elevation), std::sin(elevation));
            if (!whole.occluded(from, towards, 0.0F, far_box)) {
                return true;
            }
        }
    }
    return false;
}

} // namespace

std::vector<CurtainTriangle> site_curtains(const SourceMesh& region, const SourceScene& whole,
                                           const glm::dvec2& half_ground) {
    double bottom = std::numeric_limits<double>::infinity();
    for (const glm::dvec3& position : region.positions) {
        bottom = std::fmin(bottom, position.z - below_box);
    }
    std::vector<CurtainTriangle> curtains;
    for (const Edge& edge : open_edges(region)) {
        const glm::dvec3& a = region.positions[edge.a];
        const glm::dvec3& b = region.positions[edge.b];
        if (!on_cut(a, b, half_ground)) {
            continue;
        }
        const glm::dvec3 at = glm::mix(0.5 * (a + b), region.positions[edge.across], off_edge_share);
        if (open_below(glm::vec3(at), whole)) {
            continue;
        }
        const glm::dvec3 a_below(a.x, a.y, bottom);
        const glm::dvec3 b_below(b.x, b.y, bottom);
        curtains.push_back({a, b, b_below});
        curtains.push_back({a, b_below, a_below});
    }
    return curtains;
}

} // namespace frustumscreen::bake
