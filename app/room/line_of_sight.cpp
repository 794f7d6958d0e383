#include "app/room/line_of_sight.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace frustumscreen::room {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// True if the line passes a ball that holds the object wherever its motion has it.
bool passes_by(const Line& line, const Object& object, const glm::dvec3& box_size, double grown) {
    const glm::dvec3 middle = object.place_m + glm::dvec3(0.0, 0.0, 0.5 * object.size_m * box_size.z);
    const double radius_m =
        0.5 * grown * object.size_m * glm::length(box_size) + glm::length(object.motion.sway_m);
    const glm::dvec3 ahead = line.through_m - line.from_m;
    const glm::dvec3 off = glm::cross(ahead, middle - line.from_m);
    return glm::dot(off, off) > radius_m * radius_m * glm::dot(ahead, ahead);
}

} // namespace

bool goes_through(const Line& line, const std::array<glm::dvec3, 4>& corners_m) {
    const glm::dvec3 right = corners_m[1] - corners_m[0];
    const glm::dvec3 down = corners_m[3] - corners_m[0];
    const glm::dvec3 normal = glm::cross(right, down);
    const glm::dvec3 ahead = line.through_m - line.from_m;
    const double nears = glm::dot(ahead, normal);
    const double along = glm::dot(corners_m[0] - line.from_m, normal) / nears;
    if (nears == 0.0 || !(along > 0.0)) {
        return false;
    }
    const glm::dvec3 at = line.from_m + along * ahead - corners_m[0];
    const double x = glm::dot(at, right) / glm::dot(right, right);
    const double y = glm::dot(at, down) / glm::dot(down, down);
    return x >= 0.0 && x <= 1.0 && y >= 0.0 && y <= 1.0;
}

std::optional<double> meets(const Line& line, const Object& object, const glm::dvec3& box_size,
                            double seconds, double grown) {
    if (line.from_m == line.through_m || passes_by(line, object, box_size, grown)) {
        return std::nullopt;
    }
    const geometry::RigidTransform object_from_table = table_from_object(object, seconds).inverse();
    const glm::dvec3 middle(0.0, 0.0, 0.5 * object.size_m * box_size.z);
    const glm::dvec3 half = 0.5 * grown * object.size_m * box_size;
    const glm::dvec3 from = object_from_table.point(line.from_m) - middle;
    const glm::dvec3 ahead = object_from_table.direction(line.through_m - line.from_m);
    double enters = 1.0;
    double leaves = infinity;
    for (int axis = 0; axis < 3; ++axis) {
        if (ahead[axis] == 0.0) {
            leaves = std::abs(from[axis]) <= half[axis] ? leaves : -infinity;
            continue;
        }
        const double a = (-half[axis] - from[axis]) / ahead[axis];
        const double b = (half[axis] - from[axis]) / ahead[axis];
        enters = std::max(enters, std::min(a, b));
        leaves = std::min(leaves, std::max(a, b));
    }
    return enters <= leaves ? std::optional(enters) : std::nullopt;
}

std::optional<std::size_t> first_met(const Line& line, std::span<const Object> objects,
                                     std::span<const SeenObject> seen, double seconds,
                                     const std::optional<std::size_t>& before) {
    std::optional<std::size_t> first;
    double nearest = infinity;
    for (std::size_t k = 0; k < seen.size(); ++k) {
        const auto& [object, box_size] = seen[k];
        const double grown = before == object ? held_size : 1.0;
        const std::optional<double> at = meets(line, objects[object], box_size, seconds, grown);
        if (at && *at < nearest) {
            first = k;
            nearest = *at;
        }
    }
    return first;
}

} // namespace frustumscreen::room
