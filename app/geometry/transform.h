/// Rigid transforms in 64-bit.
///
/// Frames   a transform is named to_from: `table_from_prop` maps prop coordinates into table coordinates.
/// Units    metres; quaternions are Hamilton, unit, w x y z; q and -q are one pose.
/// Threads  values; any.
#pragma once

#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>

#include <optional>

namespace frustumscreen::geometry {

struct RigidTransform {
    glm::dquat rotation{1.0, 0.0, 0.0, 0.0};
    glm::dvec3 translation{0.0};

    [[nodiscard]] glm::dvec3 point(const glm::dvec3& p) const { return rotation * p + translation; }
    [[nodiscard]] glm::dvec3 direction(const glm::dvec3& d) const { return rotation * d; }
    [[nodiscard]] RigidTransform inverse() const;
    [[nodiscard]] glm::dmat4 matrix() const;
};

/// a_from_c = a_from_b * b_from_c.
[[nodiscard]] RigidTransform operator*(const RigidTransform& a_from_b, const RigidTransform& b_from_c);

/// The rigid transform of `matrix`; nullopt if it is not finite, scales, shears, mirrors or projects (beyond
/// 1e-6).
[[nodiscard]] std::optional<RigidTransform> rigid_from_matrix(const glm::dmat4& matrix);

/// A unit quaternion from any finite, non-zero one; otherwise nullopt.
[[nodiscard]] std::optional<glm::dquat> normalised(const glm::dquat& q);

} // namespace frustumscreen::geometry
