#include "app/scene/visible_triangles.h"

#include <cmath>
#include <limits>
#include <span>

namespace frustumscreen::scene {

namespace {

bool is_within(const glm::vec3& eye, const LevelTriangles& level) {
    glm::vec3 low(std::numeric_limits<float>::infinity());
    glm::vec3 high = -low;
    for (const LevelTriangles::Extent& extent : level.extents) {
        low = glm::min(low, extent.low);
        high = glm::max(high, extent.high);
    }
    return glm::all(glm::greaterThanEqual(eye, low)) && glm::all(glm::lessThanEqual(eye, high));
}

bool looks_away(const glm::dvec3& eye, const pack::PackCluster& cluster) {
    const glm::dvec3 to_apex = glm::dvec3(cluster.cone_apex) - eye;
    // A small tolerance keeps cones that are stored as floats on the safe side.
    constexpr double hair = 1e-5;
    const double cutoff = static_cast<double>(cluster.cone_cutoff) + hair;
    return cutoff <= 1.0 && glm::dot(to_apex, glm::dvec3(cluster.cone_axis)) > cutoff * glm::length(to_apex);
}

/// The half spaces whose boundary crosses one cluster.
struct Crossed {
    std::array<glm::vec4, FaceVolume::max_half_spaces> half_spaces; ///< the first `count`
    std::size_t count = 0;
    bool outside = false;
};

Crossed crossed_by(const pack::PackCluster& cluster, const FaceVolume& volume, double margin_box) {
    Crossed crossed;
    const glm::dvec4 centre(glm::dvec3(cluster.centre), 1.0);
    const double reach = static_cast<double>(cluster.radius) + margin_box;
    for (std::size_t k = 0; k < volume.count; ++k) {
        const double inside = glm::dot(volume.half_spaces[k], centre);
        if (inside < -reach) {
            crossed.outside = true;
            return crossed;
        }
        if (inside < reach) {
            const glm::dvec4 widened = volume.half_spaces[k] + glm::dvec4(0.0, 0.0, 0.0, margin_box);
            crossed.half_spaces[crossed.count++] = glm::vec4(widened);
        }
    }
    return crossed;
}

bool misses(const Crossed& crossed, const LevelTriangles& level, std::span<const std::uint32_t> corners) {
    for (std::size_t k = 0; k < crossed.count; ++k) {
        const glm::vec4& h = crossed.half_spaces[k];
        const auto outside = [&](std::uint32_t corner) {
            return glm::dot(glm::vec3(h), level.positions[corner]) + h.w < 0.0F;
        };
        if (outside(corners[0]) && outside(corners[1]) && outside(corners[2])) {
            return true;
        }
    }
    return false;
}

} // namespace

std::uint64_t bytes_of(const LevelTriangles& level) {
    return level.clusters.size() * sizeof(pack::PackCluster) +
           level.extents.size() * sizeof(LevelTriangles::Extent) +
           level.indices.size() * sizeof(std::uint32_t) + level.positions.size() * sizeof(glm::vec3) +
           4 * level.distance.size() * sizeof(float);
}

void find_planes(LevelTriangles& level) {
    for (std::size_t first = 0; first + 2 < level.indices.size(); first += 3) {
        const glm::dvec3 a(level.positions[level.indices[first]]);
        const glm::dvec3 b(level.positions[level.indices[first + 1]]);
        const glm::dvec3 c(level.positions[level.indices[first + 2]]);
        const glm::dvec3 area_normal = glm::cross(b - a, c - a);
        const double length = glm::length(area_normal);
        const glm::dvec3 normal = length > 0.0 ? area_normal / length : glm::dvec3(0.0);
        level.normal_x.push_back(static_cast<float>(normal.x));
        level.normal_y.push_back(static_cast<float>(normal.y));
        level.normal_z.push_back(static_cast<float>(normal.z));
        level.distance.push_back(static_cast<float>(glm::dot(normal, a)));
    }
}

void find_extents(LevelTriangles& level) {
    for (const pack::PackCluster& cluster : level.clusters) {
        LevelTriangles::Extent extent{glm::vec3(std::numeric_limits<float>::infinity()),
                                      glm::vec3(-std::numeric_limits<float>::infinity())};
        for (std::uint32_t k = 0; k < cluster.index_count; ++k) {
            const glm::vec3& corner = level.positions[level.indices[cluster.first_index + k]];
            extent.low = glm::min(extent.low, corner);
            extent.high = glm::max(extent.high, corner);
        }
        level.extents.push_back(extent);
    }
}

LevelTriangles triangles_of(const pack::PackLevel& level, const glm::dvec3& box_size) {
    LevelTriangles result;
    result.clusters = level.clusters;
    result.indices = level.indices;
    const glm::dvec3 low(-0.5 * box_size.x, -0.5 * box_size.y, 0.0);
    for (const pack::PackVertex& vertex : level.vertices) {
        const glm::dvec3 unit =
            glm::dvec3(vertex.position[0], vertex.position[1], vertex.position[2]) / 65535.0;
        result.positions.emplace_back(low + unit * box_size);
    }
    find_planes(result);
    find_extents(result);
    return result;
}

void FaceVolume::add(const glm::dvec4& half_space) {
    const double length = glm::length(glm::dvec3(half_space));
    const glm::dvec4 unit = half_space / length;
    if (length > 0.0 && std::isfinite(unit.x + unit.y + unit.z + unit.w) && count < half_spaces.size()) {
        half_spaces[count++] = unit;
    }
}

void FrontTriangles::reserve(std::size_t indices) {
    indices_.reserve(indices);
    first_.reserve(indices / 3 + 1); // a cluster has at least one triangle
}

void FrontTriangles::update(const LevelTriangles& level, const glm::dvec3& eye_box) {
    if (level_ == &level && eye_box_ == eye_box) {
        return;
    }
    level_ = &level;
    eye_box_ = eye_box;
    const glm::vec3 eye(eye_box);
    const bool both_sides = backs_ == Backs::Always || (backs_ == Backs::FromWithin && is_within(eye, level));
    // Upper bound of the products' rounding error, for an eye at any distance.
    const float slack =
        both_sides ? std::numeric_limits<float>::infinity()
                   : edge_on_box + 4.0F * std::numeric_limits<float>::epsilon() * (1.0F + glm::length(eye));
    indices_.resize(level.indices.size());
    first_.clear();
    std::uint32_t* out = indices_.data();
    for (const pack::PackCluster& cluster : level.clusters) {
        first_.push_back(static_cast<std::size_t>(out - indices_.data()));
        if (!both_sides && looks_away(eye_box, cluster)) {
            continue;
        }
        const std::size_t end = (cluster.first_index + cluster.index_count) / 3;
        for (std::size_t t = cluster.first_index / 3; t < end; ++t) {
            const float in_front = level.normal_x[t] * eye.x + level.normal_y[t] * eye.y +
                                   level.normal_z[t] * eye.z - level.distance[t];
            out[0] = level.indices[3 * t];
            out[1] = level.indices[3 * t + 1];
            out[2] = level.indices[3 * t + 2];
            out += in_front < -slack ? 0 : 3; // a branch would be mispredicted often
        }
    }
    first_.push_back(static_cast<std::size_t>(out - indices_.data()));
}

std::size_t append_visible(const FaceVolume& volume, const LevelTriangles& level, const FrontTriangles& front,
                           std::size_t cluster, std::vector<std::uint32_t>& indices, double margin_box) {
    const std::span<const std::uint32_t> facing = front.of(cluster);
    if (facing.empty()) {
        return 0;
    }
    const Crossed crossed = crossed_by(level.clusters[cluster], volume, margin_box);
    if (crossed.outside) {
        return 0;
    }
    if (crossed.count == 0) {
        indices.insert(indices.end(), facing.begin(), facing.end());
        return facing.size() / 3;
    }
    const std::size_t begin = indices.size();
    for (std::size_t k = 0; k < facing.size(); k += 3) {
        const std::span<const std::uint32_t> corners = facing.subspan(k, 3);
        if (!misses(crossed, level, corners)) {
            indices.insert(indices.end(), corners.begin(), corners.end());
        }
    }
    return (indices.size() - begin) / 3;
}

} // namespace frustumscreen::scene
