#include "app/tags/tag_starts.h"

#include <cmath>

namespace frustumscreen::tags {

namespace {

/// Columns of the homography from (0..1, 0..1), x to the right and y down as printed, to directions, up to a
/// factor.
std::optional<glm::dmat3> homography(const std::array<glm::dvec2, 4>& c) {
    const glm::dvec2 d1 = c[1] - c[2];
    const glm::dvec2 d2 = c[3] - c[2];
    const glm::dvec2 sum = c[0] - c[1] + c[2] - c[3];
    const double det = d1.x * d2.y - d2.x * d1.y;
    if (!(std::fabs(det) > 0.0)) {
        return std::nullopt;
    }
    const double g = (sum.x * d2.y - d2.x * sum.y) / det;
    const double h = (d1.x * sum.y - sum.x * d1.y) / det;
    return glm::dmat3(glm::dvec3(c[1] - c[0] + g * c[1], g), glm::dvec3(c[3] - c[0] + h * c[3], h),
                      glm::dvec3(c[0], 1.0));
}

} // namespace

geometry::RigidTransform mirrored(const geometry::RigidTransform& camera_from_tag) {
    const glm::dvec3 sight = glm::normalize(camera_from_tag.translation);
    const glm::dvec3 normal = camera_from_tag.direction({0.0, 0.0, 1.0});
    const glm::dvec3 other = 2.0 * glm::dot(normal, sight) * sight - normal;
    const glm::dvec3 axis = glm::cross(normal, other);
    const double sine = glm::length(axis);
    if (!(sine > 0.0)) { // seen from straight above: only one pose
        return camera_from_tag;
    }
    const glm::dquat turn = glm::angleAxis(std::atan2(sine, glm::dot(normal, other)), axis / sine);
    return {glm::normalize(turn * camera_from_tag.rotation), camera_from_tag.translation};
}

std::optional<geometry::RigidTransform> tag_start(const std::array<glm::dvec2, 4>& corners, double size_m) {
    const std::optional<glm::dmat3> h = homography(corners);
    if (!h) {
        return std::nullopt;
    }
    const glm::dmat3& columns = *h;
    const glm::dvec3 middle = 0.5 * columns[0] + 0.5 * columns[1] + columns[2];
    // Both sides of a square are equally long; the factor is the mean of their estimates.
    const double scale = 2.0 * size_m / (glm::length(columns[0]) + glm::length(columns[1]));
    const glm::dvec3 right = glm::normalize(columns[0]);
    const glm::dvec3 down_raw = columns[1] - glm::dot(columns[1], right) * right;
    const bool well = std::isfinite(scale) && glm::length(down_raw) > 0.0 && middle.z * scale > 0.0;
    if (!well) {
        return std::nullopt;
    }
    const glm::dvec3 up = -glm::normalize(down_raw);
    const glm::dmat3 axes(right, up, glm::cross(right, up));
    return geometry::RigidTransform{glm::normalize(glm::dquat(axes)), scale * middle};
}

} // namespace frustumscreen::tags
