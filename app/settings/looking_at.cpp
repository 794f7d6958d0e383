#include "app/settings/looking_at.h"

namespace frustumscreen::settings {

std::optional<geometry::RigidTransform> looking_at(const glm::dvec3& position, const glm::dvec3& aim,
                                                   double roll_deg) {
    constexpr double min_m = 1e-6;
    const glm::dvec3 far_side(0.0, 1.0, 0.0);
    if (glm::distance(aim, position) < min_m) {
        return std::nullopt;
    }
    const glm::dvec3 forward = glm::normalize(aim - position);
    const glm::dvec3 up = far_side - forward * glm::dot(far_side, forward);
    if (glm::length(up) < min_m) {
        return std::nullopt;
    }
    const glm::dvec3 down = -glm::normalize(up);
    const double roll = glm::radians(roll_deg);
    const glm::dquat rolled = glm::angleAxis(roll, glm::dvec3(0.0, 0.0, 1.0));
    const glm::dquat rotation = glm::quat_cast(glm::dmat3(glm::cross(down, forward), down, forward));
    return geometry::RigidTransform{glm::normalize(rotation * rolled), position};
}

} // namespace frustumscreen::settings
