/// A small pack made in memory, and the table of the render tests.
#pragma once

#include "app/geometry/prop_shape.h"
#include "app/pack/pack.h"
#include "app/scene/frame_plan.h"

#include <glm/gtc/quaternion.hpp>
#include <meshoptimizer.h>

#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>
#include <string>
#include <vector>

namespace frustumscreen::synthetic {

struct Soup {
    std::vector<glm::dvec3> points;
    std::vector<std::uint32_t> indices;
};

/// A closed tube of circular section around a ring: counter-clockwise from outside.
inline void add_torus(Soup& soup, const glm::dvec3& centre, const glm::dmat3& turn, double ring, double tube,
                      std::uint32_t around, std::uint32_t across) {
    const auto first = static_cast<std::uint32_t>(soup.points.size());
    for (std::uint32_t i = 0; i < around; ++i) {
        for (std::uint32_t j = 0; j < across; ++j) {
            const double a = 2.0 * std::numbers::pi * i / around;
            const double b = 2.0 * std::numbers::pi * j / across;
            const double r = ring + tube * std::cos(b);
            soup.points.push_back(centre +
                                  turn * glm::dvec3(r * std::cos(a), r * std::sin(a), tube * std::sin(b)));
            const std::uint32_t i1 = (i + 1) % around;
            const std::uint32_t j1 = (j + 1) % across;
            const std::uint32_t p = first + i * across + j;
            const std::uint32_t q = first + i1 * across + j;
            const std::uint32_t p1 = first + i * across + j1;
            const std::uint32_t q1 = first + i1 * across + j1;
            soup.indices.insert(soup.indices.end(), {p, q, q1, p, q1, p1});
        }
    }
}

/// Clusters are plain runs of triangles with meshoptimizer's bounds.
inline std::vector<pack::PackCluster> cluster(const std::vector<glm::vec3>& points,
                                              const std::vector<std::uint32_t>& indices,
                                              std::size_t triangles) {
    std::vector<pack::PackCluster> clusters;
    for (std::size_t first = 0; first < indices.size(); first += 3 * triangles) {
        const std::size_t count = std::min(3 * triangles, indices.size() - first);
        const meshopt_Bounds b = meshopt_computeClusterBounds(indices.data() + first, count, &points[0].x,
                                                              points.size(), sizeof(glm::vec3));
        pack::PackCluster c;
        c.first_index = static_cast<std::uint32_t>(first);
        c.index_count = static_cast<std::uint32_t>(count);
        c.centre = {b.center[0], b.center[1], b.center[2]};
        c.radius = b.radius;
        c.cone_apex = {b.cone_apex[0], b.cone_apex[1], b.cone_apex[2]};
        c.cone_axis = {b.cone_axis[0], b.cone_axis[1], b.cone_axis[2]};
        c.cone_cutoff = b.cone_cutoff < 1.0F ? b.cone_cutoff : 2.0F;
        clusters.push_back(c);
    }
    return clusters;
}

/// The box around a soup's points.
inline geometry::Box box_around(const Soup& soup) {
    geometry::Box box{glm::dvec3(1e9), glm::dvec3(-1e9)};
    for (const glm::dvec3& p : soup.points) {
        box = {glm::min(box.low, p), glm::max(box.high, p)};
    }
    return box;
}

/// A pack with one level, and a texture that tells places apart.
inline pack::Pack pack_of(const Soup& soup) {
    const auto [low, high] = box_around(soup);
    const glm::dvec3 extent = high - low;
    const double longest = std::max(extent.x, std::max(extent.y, extent.z));
    pack::Pack pack;
    pack.box_size = extent / longest;
    pack::PackLevel level;
    std::vector<glm::vec3> box_points;
    for (const glm::dvec3& p : soup.points) {
        const glm::dvec3 unit = (p - low) / extent;
        pack::PackVertex v;
        for (std::size_t k = 0; k < 3; ++k) {
            v.position[k] = static_cast<std::uint16_t>(std::lround(unit[static_cast<int>(k)] * 65535.0));
        }
        v.uv = {v.position[0], v.position[2]};
        level.vertices.push_back(v);
        const glm::dvec3 quantised = glm::dvec3(v.position[0], v.position[1], v.position[2]) / 65535.0;
        box_points.emplace_back(quantised * pack.box_size -
                                glm::dvec3(pack.box_size.x, pack.box_size.y, 0.0) * 0.5);
    }
    level.indices = soup.indices;
    level.clusters = cluster(box_points, level.indices, 32);
    pack.levels.push_back(level);
    image::Image8 texture(64, 64);
    for (int y = 0; y < 64; ++y) {
        for (int x = 0; x < 64; ++x) {
            texture.at(x, y) = {40 + 3 * x, 60 + 2 * y, ((x / 4 + y / 4) & 1) != 0 ? 230 : 90, 255};
        }
    }
    pack.textures.push_back(texture);
    return pack;
}

/// Three linked rings: concave, in several parts, occluding each other.
inline pack::Pack rings(std::uint32_t around = 24, std::uint32_t across = 12) {
    Soup soup;
    const glm::dmat3 upright(glm::dvec3(1, 0, 0), glm::dvec3(0, 0, 1), glm::dvec3(0, -1, 0));
    const glm::dmat3 sideways(glm::dvec3(0, 1, 0), glm::dvec3(0, 0, 1), glm::dvec3(1, 0, 0));
    add_torus(soup, {0.0, 0.0, 0.12}, glm::dmat3(1.0), 0.38, 0.12, around, across);
    add_torus(soup, {0.05, 0.0, 0.45}, upright, 0.27, 0.08, around, across);
    add_torus(soup, {0.0, 0.05, 0.70}, sideways, 0.22, 0.06, around, across);
    return pack_of(soup);
}

/// The scale at which the box's corners stay inside the default prop.
inline double metres_per_box(const pack::Pack& pack, const geometry::PropShape& prop) {
    std::vector<glm::dvec3> corners;
    for (unsigned k = 0; k < 8; ++k) {
        corners.emplace_back(((k & 1U) != 0 ? 0.5 : -0.5) * pack.box_size.x,
                             ((k & 2U) != 0 ? 0.5 : -0.5) * pack.box_size.y,
                             (k & 4U) != 0 ? pack.box_size.z : 0.0);
    }
    return geometry::largest_scale_inside(prop, corners);
}

/// A projector above the table that looks straight down; if `near`, the prop covers about a quarter of the
/// picture.
struct TestTable {
    geometry::PropShape prop = geometry::make_frustum({});
    geometry::Pinhole projector;
    geometry::RigidTransform table_from_projector{{0.0, 1.0, 0.0, 0.0}, {0.0, 0.0, 0.9}};
    geometry::RigidTransform table_from_prop;
    glm::dvec3 eye_m{0.1, -0.5, 0.45};

    explicit TestTable(int width, int height, bool near = true)
        : projector{width,
                    height,
                    width / 1280.0 * (near ? 3010.0 : 1400.0),
                    width / 1280.0 * (near ? 3010.0 : 1400.0),
                    width * 0.5,
                    height * 0.5} {}
    [[nodiscard]] scene::PlanView view(std::optional<scene::LightCompensation> light = std::nullopt) const {
        return {projector, table_from_projector, table_from_prop, std::span(&eye_m, 1), light};
    }
    /// The prop held over the table in any orientation; the eye anywhere above.
    void hold(std::mt19937& random) {
        std::normal_distribution<double> normal;
        std::uniform_real_distribution<double> u(-1.0, 1.0);
        shuffle(random);
        const glm::dquat rotation =
            glm::normalize(glm::dquat(normal(random), normal(random), normal(random), normal(random)));
        const glm::dvec3 middle(0.03 * u(random), 0.02 * u(random), 0.16 + 0.04 * u(random));
        table_from_prop = {rotation, middle - rotation * prop.middle};
    }
    /// A prop at any yaw near the middle, and an eye anywhere above the table.
    void shuffle(std::mt19937& random) {
        std::uniform_real_distribution<double> u(-1.0, 1.0);
        const double yaw = std::numbers::pi * u(random);
        table_from_prop = {glm::dquat(std::cos(yaw / 2), 0.0, 0.0, std::sin(yaw / 2)),
                           {0.04 * u(random), 0.02 * u(random), 0.0}};
        const double azimuth = std::numbers::pi * u(random);
        const double elevation = 0.3 + 0.55 * (u(random) + 1.0);
        const double distance = 0.7 + 0.3 * u(random);
        eye_m = distance * glm::dvec3(std::cos(elevation) * std::cos(azimuth),
                                      std::cos(elevation) * std::sin(azimuth), std::sin(elevation));
    }
};

/// Adds the parts of a file that are not drawn.
inline void complete(pack::Pack& pack) {
    pack.provenance.source_name = "rings.glb";
    pack.provenance.source_sha256 = std::string(64, 'a');
    pack.relief_size = 512;
    for (unsigned k = 0; k < 8; ++k) {
        pack.extremes.emplace_back(((k & 1U) != 0 ? 0.5 : -0.5) * pack.box_size.x,
                                   ((k & 2U) != 0 ? 0.5 : -0.5) * pack.box_size.y,
                                   (k & 4U) != 0 ? pack.box_size.z : 0.0);
    }
}

} // namespace frustumscreen::synthetic
