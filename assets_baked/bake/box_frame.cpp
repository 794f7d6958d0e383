#include "assets_baked/bake/box_frame.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace frustumscreen::bake {

namespace {

/// A profile point: horizontal coordinate, height, and index of its source point.
struct ProfilePoint {
    double across;
    double height;
    std::size_t source;
};

double turn(const ProfilePoint& a, const ProfilePoint& b, const ProfilePoint& c) {
    return (b.across - a.across) * (c.height - a.height) - (b.height - a.height) * (c.across - a.across);
}

/// Convex hull by monotone chain (Andrew 1979).
void append_hull(std::vector<ProfilePoint> points, std::vector<std::size_t>& sources) {
    std::sort(points.begin(), points.end(), [](const ProfilePoint& a, const ProfilePoint& b) {
        return a.across != b.across ? a.across < b.across : a.height < b.height;
    });
    for (int side = 0; side < 2; ++side) {
        std::vector<ProfilePoint> chain;
        for (const ProfilePoint& point : points) {
            while (chain.size() >= 2 && turn(chain[chain.size() - 2], chain.back(), point) <= 0.0) {
                chain.pop_back();
            }
            chain.push_back(point);
        }
        for (const ProfilePoint& point : chain) {
            sources.push_back(point.source);
        }
        std::reverse(points.begin(), points.end());
    }
}

} // namespace

std::optional<glm::dmat3> up_rotation(std::string_view up) {
    // Rows: the images of the file's axes.
    const auto rows = [](glm::dvec3 x, glm::dvec3 y, glm::dvec3 z) {
        return glm::transpose(glm::dmat3(x, y, z));
    };
    if (up == "z" || up == "+z") {
        return glm::dmat3(1.0);
    }
    if (up == "-z") {
        return rows({1, 0, 0}, {0, -1, 0}, {0, 0, -1});
    }
    if (up == "y" || up == "+y") {
        return rows({1, 0, 0}, {0, 0, -1}, {0, 1, 0});
    }
    if (up == "-y") {
        return rows({1, 0, 0}, {0, 0, 1}, {0, -1, 0});
    }
    if (up == "x" || up == "+x") {
        return rows({0, 1, 0}, {0, 0, 1}, {1, 0, 0});
    }
    if (up == "-x") {
        return rows({0, -1, 0}, {0, 0, 1}, {-1, 0, 0});
    }
    return std::nullopt;
}

glm::dmat3 turn_rotation(double turn_deg) {
    const double quarters = std::round(turn_deg / 90.0);
    const double rest = (turn_deg - 90.0 * quarters) * std::numbers::pi / 180.0;
    const glm::dvec3 x(std::cos(rest), std::sin(rest), 0.0);
    const glm::dvec3 y(-x.y, x.x, 0.0);
    switch (static_cast<int>(std::fmod(quarters, 4.0) + 4.0) % 4) {
    case 1:
        return {y, -x, {0, 0, 1}};
    case 2:
        return {-x, -y, {0, 0, 1}};
    case 3:
        return {-y, x, {0, 0, 1}};
    default:
        return {x, y, {0, 0, 1}};
    }
}

Result<BoxFrame> make_box_frame(const SourceMesh& mesh, const Standing& standing) {
    const std::optional<glm::dmat3> upright = up_rotation(standing.up);
    if (!upright) {
        return bad_input("bake.up_axis",
                         "the up axis is '" + standing.up + "'; allowed are x, y, z, -x, -y, -z");
    }
    const glm::dmat3 rotation = turn_rotation(standing.turn_deg) * *upright;
    glm::dvec3 low(std::numeric_limits<double>::infinity());
    glm::dvec3 high(-std::numeric_limits<double>::infinity());
    for (const auto& triangle : mesh.triangles) {
        for (const std::uint32_t vertex : triangle) {
            const glm::dvec3 p = rotation * mesh.positions[vertex];
            low = glm::min(low, p);
            high = glm::max(high, p);
        }
    }
    const glm::dvec3 extent = high - low;
    const glm::dvec3 size(extent.x, extent.y, extent.z * (1.0 + standing.lift));
    const double longest = std::max({size.x, size.y, size.z});
    if (!(longest > 1e-30) || !(longest < 1e30)) {
        return bad_input("bake.no_extent",
                         "the artifact's bounding box has no extent; there is nothing to show");
    }
    BoxFrame frame;
    frame.file_units_per_box = longest;
    frame.turned_from_file = rotation;
    frame.low = low;
    frame.extent = extent;
    frame.lift_box = standing.lift * extent.z / longest;
    frame.box_size = glm::max(size / longest, glm::dvec3(1e-6));
    const glm::dvec3 foot((low.x + high.x) / 2.0, (low.y + high.y) / 2.0, low.z);
    frame.box_from_file = glm::dmat4(rotation / longest);
    frame.box_from_file[3] = glm::dvec4(glm::dvec3(0, 0, frame.lift_box) - foot / longest, 1.0);
    return frame;
}

std::vector<glm::dvec3> in_box(const SourceMesh& mesh, const BoxFrame& frame) {
    // The corner of the bounding box is subtracted first: this loses no precision, however far away the
    // origin is.
    const glm::dvec3 foot(0.5 * frame.extent.x / frame.file_units_per_box,
                          0.5 * frame.extent.y / frame.file_units_per_box, -frame.lift_box);
    std::vector<glm::dvec3> points;
    points.reserve(mesh.positions.size());
    for (const glm::dvec3& p : mesh.positions) {
        points.push_back((frame.turned_from_file * p - frame.low) / frame.file_units_per_box - foot);
    }
    return points;
}

std::vector<glm::dvec3> in_box(const SourceMesh& mesh, const glm::dmat4& box_from_file) {
    std::vector<glm::dvec3> points;
    points.reserve(mesh.positions.size());
    for (const glm::dvec3& position : mesh.positions) {
        points.emplace_back(box_from_file * glm::dvec4(position, 1.0));
    }
    return points;
}

std::vector<glm::dvec3> profile_extremes(std::span<const glm::dvec3> points) {
    std::vector<std::size_t> sources;
    for (int axis = 0; axis < 2; ++axis) {
        std::vector<ProfilePoint> profile;
        profile.reserve(points.size());
        for (std::size_t k = 0; k < points.size(); ++k) {
            profile.push_back({points[k][axis], points[k].z, k});
        }
        append_hull(std::move(profile), sources);
    }
    std::sort(sources.begin(), sources.end());
    sources.erase(std::unique(sources.begin(), sources.end()), sources.end());
    std::vector<glm::dvec3> extremes;
    extremes.reserve(sources.size());
    for (const std::size_t source : sources) {
        extremes.push_back(points[source]);
    }
    return extremes;
}

} // namespace frustumscreen::bake
