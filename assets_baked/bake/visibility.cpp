#include "assets_baked/bake/visibility.h"

#include "firmware_host/base/parallel.h"

#include <array>
#include <cmath>
#include <numbers>

namespace frustumscreen::bake {

namespace {

enum Side : std::uint8_t { none = 0, front = 1, back = 2, both = 3 };

/// Integer hash (the finaliser of MurmurHash3), for points that depend only on their index.
std::uint32_t hashed(std::uint32_t x) {
    x ^= x >> 16;
    x *= 0x85EBCA6BU;
    x ^= x >> 13;
    x *= 0xC2B2AE35U;
    x ^= x >> 16;
    return x;
}
float unit_number(std::uint32_t x) {
    return static_cast<float>(hashed(x) >> 8) / 16777216.0F;
}

/// Eyes spread over the zone: golden-angle azimuths, elevations even in the sine, alternating distances.
std::vector<glm::vec3> eyes_of(const ViewingZone& zone, const glm::vec3& centre) {
    constexpr int count = 1024;
    constexpr double golden_angle = 2.399963229728653;
    const double lowest = std::sin(zone.lowest_elevation_deg * std::numbers::pi / 180.0);
    const double power = lowest > 0.0 ? 1.5 : 1.0; // above a table, low eyes are more frequent
    std::vector<glm::vec3> eyes;
    for (int k = 0; k < count; ++k) {
        const double sine = lowest + (1.0 - lowest) * std::pow((k + 0.5) / count, power);
        const double cosine = std::sqrt(1.0 - sine * sine);
        const double azimuth = k * golden_angle;
        const double distance = k % 3 == 0 ? zone.farthest_box : zone.nearest_box;
        eyes.push_back(
            centre +
            glm::vec3(glm::dvec3(cosine * std::cos(azimuth), cosine * std::sin(azimuth), sine) * distance));
    }
    return eyes;
}

/// Sample weights on a triangle: first near the corners and edges, which are the first to appear in a gap.
glm::vec3 sample_weights(std::uint32_t triangle, int k) {
    static constexpr std::array<glm::vec3, 4> fixed{glm::vec3(1.0F / 3.0F), glm::vec3(0.8F, 0.1F, 0.1F),
                                                    glm::vec3(0.1F, 0.8F, 0.1F), glm::vec3(0.1F, 0.1F, 0.8F)};
    if (k < static_cast<int>(fixed.size())) {
        return fixed[static_cast<std::size_t>(k)];
    }
    const float r = std::sqrt(unit_number(triangle * 64U + static_cast<std::uint32_t>(2 * k)));
    const float s = unit_number(triangle * 64U + static_cast<std::uint32_t>(2 * k + 1));
    return {1.0F - r, r * (1.0F - s), r * s};
}

/// The search for the sides of one triangle that some eye sees, ray by ray.
class SideSearch {
public:
    void begin_sample() { goes_on_ = seen != both; }
    /// True if it wants the ray from the present sample to the eye with this number, towards `side`.
    [[nodiscard]] bool takes(std::uint32_t eye, std::uint8_t side) {
        constexpr std::uint32_t eyes_per_sample = 160;
        constexpr std::uint32_t eyes_for_other_side = 40; // if both sides are visible, many eyes see either
        goes_on_ = goes_on_ && seen != both && eye < (seen == none ? eyes_per_sample : eyes_for_other_side);
        return goes_on_ && (seen & side) == 0;
    }
    [[nodiscard]] bool goes_on() const { return goes_on_; }

    std::uint8_t seen = none;

private:
    bool goes_on_ = false;
};

/// Sides that some eye sees.
struct SeenSides {
    std::uint8_t alone = none; ///< with the scene alone
    std::uint8_t curtained = none;
};

/// Finds the sides of a triangle that the eyes see. `curtains`: null for none.
SeenSides sides_seen(const TriangleMesh& mesh, std::uint32_t triangle, const SourceScene& scene,
                     const SourceScene* curtains, const std::vector<glm::vec3>& eyes) {
    constexpr float lift = 2e-5F; // off the surface, box units: above 32-bit noise, below what a visitor sees
    const glm::vec3 area_normal = mesh.area_normal(triangle);
    const float twice_area = glm::length(area_normal);
    if (!(twice_area > 0.0F)) {
        return {};
    }
    const glm::vec3 normal = area_normal / twice_area;
    // More samples for a large triangle, which may be visible through a small gap; a small one has
    // neighbours.
    const int samples = std::min(4, 1 + static_cast<int>(twice_area * 2e4F)) +
                        std::min(28, static_cast<int>(twice_area * 5e3F));
    SideSearch alone, curtained;
    curtained.seen = curtains == nullptr ? both : none; // nothing to search
    for (int k = 0; k < samples && (alone.seen != both || curtained.seen != both); ++k) {
        const glm::vec3 w = sample_weights(triangle, k);
        const glm::vec3 p =
            mesh.corner(triangle, 0) * w.x + mesh.corner(triangle, 1) * w.y + mesh.corner(triangle, 2) * w.z;
        const std::uint32_t start = hashed(triangle * 37U + static_cast<std::uint32_t>(k));
        alone.begin_sample();
        curtained.begin_sample();
        for (std::uint32_t j = 0; alone.goes_on() || curtained.goes_on(); ++j) {
            const glm::vec3& eye = eyes[(start + j * 331U) % eyes.size()];
            const glm::vec3 towards = eye - p;
            const float facing = glm::dot(towards, normal);
            const std::uint8_t side = facing > 0.0F ? front : back;
            const bool is_for_alone = alone.takes(j, side);
            const bool is_for_curtained = curtained.takes(j, side);
            if (!is_for_alone && !is_for_curtained) {
                continue;
            }
            const glm::vec3 origin = p + normal * (facing > 0.0F ? lift : -lift);
            const float distance = glm::length(towards);
            const glm::vec3 direction = towards / distance;
            if (scene.occluded(origin, direction, lift, distance)) {
                continue;
            }
            if (is_for_alone) {
                alone.seen = static_cast<std::uint8_t>(alone.seen | side);
            }
            if (is_for_curtained && !curtains->occluded(origin, direction, lift, distance)) {
                curtained.seen = static_cast<std::uint8_t>(curtained.seen | side);
            }
        }
    }
    return {alone.seen, curtained.seen};
}

/// Spreads visible sides to touching triangles, and on over the surface for `reach_box`, which fills gaps
/// between the samples.
std::vector<std::uint8_t> grown(const TriangleMesh& mesh, const std::vector<std::uint8_t>& sides,
                                std::uint8_t side) {
    constexpr float reach_box = 5e-3F;
    constexpr int steps = 12;
    std::vector<float> away(mesh.positions.size(), 1e30F);
    for (std::size_t k = 0; k < mesh.indices.size(); ++k) {
        if ((sides[k / 3] & side) != 0) {
            away[mesh.indices[k]] = 0.0F;
        }
    }
    for (int step = 0; step < steps; ++step) {
        for (std::size_t k = 0; k < mesh.indices.size(); ++k) {
            const std::uint32_t a = mesh.indices[k];
            const std::uint32_t b = mesh.indices[k - k % 3 + (k + 1) % 3];
            const float length = glm::distance(mesh.positions[a], mesh.positions[b]);
            away[a] = std::fmin(away[a], away[b] + length);
            away[b] = std::fmin(away[b], away[a] + length);
        }
    }
    std::vector<std::uint8_t> result(sides);
    for (std::size_t k = 0; k < mesh.indices.size(); ++k) {
        if (away[mesh.indices[k]] <= reach_box) {
            result[k / 3] |= side;
        }
    }
    return result;
}

/// Flipped copies get vertices of their own, so that each side keeps its own normals.
TriangleMesh kept(const TriangleMesh& mesh, const std::vector<std::uint8_t>& sides) {
    TriangleMesh result{mesh.positions, {}};
    std::vector<std::uint32_t> twin(mesh.positions.size(), 0xFFFFFFFFU);
    const auto twin_of = [&](std::uint32_t vertex) {
        if (twin[vertex] == 0xFFFFFFFFU) {
            twin[vertex] = static_cast<std::uint32_t>(result.positions.size());
            result.positions.push_back(mesh.positions[vertex]);
        }
        return twin[vertex];
    };
    for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
        const std::array<std::uint32_t, 3> c{mesh.indices[3 * t], mesh.indices[3 * t + 1],
                                             mesh.indices[3 * t + 2]};
        if ((sides[t] & front) != 0) {
            result.indices.insert(result.indices.end(), {c[0], c[1], c[2]});
        }
        if ((sides[t] & back) != 0) {
            result.indices.insert(result.indices.end(), {twin_of(c[0]), twin_of(c[2]), twin_of(c[1])});
        }
    }
    return result;
}

/// The sides seen, for each triangle.
struct AllSides {
    std::vector<std::uint8_t> alone, curtained; ///< as SeenSides
};
AllSides all_sides_seen(const TriangleMesh& mesh, const SourceScene& scene, const SourceScene* curtains,
                        const ViewingZone& zone) {
    glm::vec3 low(1e30F);
    glm::vec3 high(-1e30F);
    for (const glm::vec3& p : mesh.positions) {
        low = glm::min(low, p);
        high = glm::max(high, p);
    }
    const std::vector<glm::vec3> eyes = eyes_of(zone, (low + high) * 0.5F);
    AllSides sides{std::vector<std::uint8_t>(mesh.triangle_count(), none),
                   std::vector<std::uint8_t>(mesh.triangle_count(), none)};
    parallel_for(mesh.triangle_count(), 256, [&](std::size_t begin, std::size_t end) {
        for (std::size_t t = begin; t < end; ++t) {
            const SeenSides seen = sides_seen(mesh, static_cast<std::uint32_t>(t), scene, curtains, eyes);
            sides.alone[t] = seen.alone;
            sides.curtained[t] = seen.curtained;
        }
    });
    sides.alone = grown(mesh, grown(mesh, sides.alone, front), back);
    if (curtains != nullptr) {
        sides.curtained = grown(mesh, grown(mesh, sides.curtained, front), back);
    }
    return sides;
}

} // namespace

TriangleMesh visible_sides(const TriangleMesh& mesh, const SourceScene& scene, const ViewingZone& zone) {
    return kept(mesh, all_sides_seen(mesh, scene, nullptr, zone).alone);
}

TriangleMesh visible_region_sides(const TriangleMesh& mesh, const SourceScene& scene,
                                  const SourceScene& curtains, const ViewingZone& zone) {
    const AllSides seen = all_sides_seen(mesh, scene, &curtains, zone);
    std::vector<std::uint8_t> sides = seen.curtained;
    for (std::size_t t = 0; t < sides.size(); ++t) {
        const std::uint8_t upper = mesh.area_normal(t).z > 0.0F ? front : back;
        sides[t] = static_cast<std::uint8_t>(sides[t] | (seen.alone[t] & upper));
    }
    return kept(mesh, sides);
}

std::vector<bool> visible_triangles(const TriangleMesh& mesh, const SourceScene& scene,
                                    const ViewingZone& zone) {
    std::vector<bool> visible;
    for (const std::uint8_t sides : all_sides_seen(mesh, scene, nullptr, zone).alone) {
        visible.push_back(sides != none);
    }
    return visible;
}

TriangleMesh visible_sides_like(const TriangleMesh& mesh, const TriangleMesh& finer,
                                const SourceScene& finer_scene, float tolerance_box) {
    const float reach = 12.0F * tolerance_box; // a few places stray much further than the tolerance
    std::vector<std::uint8_t> sides(mesh.triangle_count(), none);
    parallel_for(sides.size(), 256, [&](std::size_t begin, std::size_t end) {
        for (std::size_t t = begin; t < end; ++t) {
            const glm::vec3 area_normal = mesh.area_normal(t);
            const float twice_area = glm::length(area_normal);
            if (!(twice_area > 0.0F)) {
                continue;
            }
            const glm::vec3 normal = area_normal / twice_area;
            const int samples = 4 + std::min(60, static_cast<int>(twice_area * 5e4F));
            for (int k = 0; k < samples && sides[t] != both; ++k) {
                const glm::vec3 w = sample_weights(static_cast<std::uint32_t>(t), k);
                const glm::vec3 p =
                    mesh.corner(t, 0) * w.x + mesh.corner(t, 1) * w.y + mesh.corner(t, 2) * w.z;
                // Looks along the normal in both directions, so that each side of a thin wall finds its own.
                for (const float sign : {1.0F, -1.0F}) {
                    const glm::vec3 origin = p + normal * (sign * tolerance_box);
                    const SurfaceHit hit = finer_scene.nearest(origin, reach);
                    if (hit.hit) {
                        const glm::vec3 n = finer.area_normal(hit.triangle);
                        sides[t] |= glm::dot(n, normal) > 0.0F ? front : back;
                    }
                }
            }
        }
    });
    return kept(mesh, sides);
}

} // namespace frustumscreen::bake
