#include "app/calibration/procedure/rest_posture.h"

#include "app/calibration/dense_solvers.h"
#include "app/geometry/rotation_angle.h"

#include <algorithm>
#include <cmath>

namespace frustumscreen::calibration {

std::optional<FlatPosture> flat_posture(std::span<const geometry::RigidTransform> rests) {
    constexpr double min_turn_rad = 0.17;
    Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
    double turn_rad = 0.0;
    for (const geometry::RigidTransform& a : rests) {
        for (const geometry::RigidTransform& b : rests) {
            turn_rad = std::fmax(turn_rad, geometry::rotation_angle(a.rotation, b.rotation));
            const glm::dmat3 between = glm::mat3_cast(glm::conjugate(a.rotation) * b.rotation);
            Eigen::Matrix3d off;
            for (int row = 0; row < 3; ++row) {
                for (int column = 0; column < 3; ++column) {
                    off(row, column) = between[column][row] - (row == column ? 1.0 : 0.0);
                }
            }
            sum += off.transpose() * off;
        }
    }
    if (turn_rad < min_turn_rad) {
        return std::nullopt;
    }
    // The rests' common axis, in the sensor: no rotation between them moves it.
    const Eigen::Vector3d axis = axes_of(sum).vectors.col(0);
    FlatPosture flat;
    flat.in_sensor = {axis.x(), axis.y(), axis.z()};
    glm::dvec3 normals(0.0);
    for (const geometry::RigidTransform& rest : rests) {
        normals += rest.direction(flat.in_sensor);
    }
    flat.normal = glm::normalize(normals);
    for (const geometry::RigidTransform& rest : rests) {
        const RestStance stance = stance_of(flat, rest);
        flat.height_m += glm::dot(flat.normal, rest.translation) / static_cast<double>(rests.size());
        flat.tilt_rad = std::fmax(flat.tilt_rad, stance.tilt_rad);
    }
    return flat;
}

RestStance stance_of(const FlatPosture& flat, const geometry::RigidTransform& rest) {
    const double along = glm::dot(flat.normal, rest.direction(flat.in_sensor));
    return {std::acos(std::clamp(along, -1.0, 1.0)), glm::dot(flat.normal, rest.translation) - flat.height_m};
}

} // namespace frustumscreen::calibration
