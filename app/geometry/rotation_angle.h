/// The angle between two rotations.
///
/// Units    radians, 0 to pi. Quaternions are unit; two signs of one rotation are one rotation.
/// Threads  pure; any.
#pragma once

#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>

#include <algorithm>
#include <cmath>

namespace frustumscreen::geometry {

[[nodiscard]] inline double rotation_angle(const glm::dquat& a, const glm::dquat& b) {
    return 2.0 * std::acos(std::min(1.0, std::abs(glm::dot(a, b))));
}

} // namespace frustumscreen::geometry
