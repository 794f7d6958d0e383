#include "app/geometry/transform.h"

#include <cmath>

namespace frustumscreen::geometry {

RigidTransform RigidTransform::inverse() const {
    const glm::dquat inverse_rotation = glm::conjugate(rotation);
    return {inverse_rotation, -(inverse_rotation * translation)};
}

glm::dmat4 RigidTransform::matrix() const {
    glm::dmat4 result = glm::mat4_cast(rotation);
    result[3] = glm::dvec4(translation, 1.0);
    return result;
}

RigidTransform operator*(const RigidTransform& a_from_b, const RigidTransform& b_from_c) {
    return {glm::normalize(a_from_b.rotation * b_from_c.rotation), a_from_b.point(b_from_c.translation)};
}

std::optional<RigidTransform> rigid_from_matrix(const glm::dmat4& matrix) {
    constexpr double tolerance = 1e-6;
    for (int column = 0; column < 4; ++column) {
        for (int row = 0; row < 4; ++row) {
            if (!std::isfinite(matrix[column][row])) {
                return std::nullopt;
            }
        }
        if (std::abs(matrix[column][3] - (column == 3 ? 1.0 : 0.0)) > tolerance) {
            return std::nullopt;
        }
    }
    const glm::dmat3 rotation(matrix);
    const glm::dmat3 should_be_identity = glm::transpose(rotation) * rotation;
    for (int column = 0; column < 3; ++column) {
        for (int row = 0; row < 3; ++row) {
            if (std::abs(should_be_identity[column][row] - (column == row ? 1.0 : 0.0)) > tolerance) {
                return std::nullopt;
            }
        }
    }
    if (glm::determinant(rotation) < 0.0) {
        return std::nullopt;
    }
    return RigidTransform{glm::normalize(glm::quat_cast(rotation)), glm::dvec3(matrix[3])};
}

std::optional<glm::dquat> normalised(const glm::dquat& q) {
    const double largest =
        std::fmax(std::fmax(std::abs(q.w), std::abs(q.x)), std::fmax(std::abs(q.y), std::abs(q.z)));
    if (!std::isfinite(q.w) || !std::isfinite(q.x) || !std::isfinite(q.y) || !std::isfinite(q.z) ||
        largest < 1e-300) {
        return std::nullopt;
    }
    return glm::normalize(q / largest);
}

} // namespace frustumscreen::geometry
