#include "app/calibration/rigid_move.h"

#include <Eigen/Geometry>
#include <cmath>

namespace frustumscreen::calibration {

geometry::RigidTransform rigid(const RigidMove& move, const glm::dvec3& middle) {
    const glm::dquat turn = glm::normalize(glm::dquat(1.0, 0.5 * move[0], 0.5 * move[1], 0.5 * move[2]));
    return {turn, middle + glm::dvec3(move[3], move[4], move[5]) - turn * middle};
}

std::string_view name_of(Moved moved) {
    switch (moved) {
    case Moved::Projector:
        return "projector";
    case Moved::Tracker:
        return "tracker";
    case Moved::Either:
        return "either";
    default:
        return "nothing";
    }
}

RigidMove usual_move_weights() {
    RigidMove weights;
    weights << Eigen::Vector3d::Constant(std::pow(usual_turn_rad, -2.0)),
        Eigen::Vector3d::Constant(std::pow(usual_shift_m, -2.0));
    return weights;
}

TouchModel model_of(const CalibratedTable& table) {
    TouchModel model;
    model.pinhole = table.pinhole;
    model.projector_from_tracker = table.table_from_projector.inverse() * table.table_from_tracker;
    model.sensor_offset_m = table.sensor_offset_m;
    model.table_up = glm::conjugate(table.table_from_tracker.rotation) * glm::dvec3(0.0, 0.0, 1.0);
    model.table_offset_m = table.table_from_tracker.translation.z;
    return model;
}

TouchModel moved_model(const TouchModel& kept, Moved which, const RigidMove& move, const glm::dvec3& middle) {
    const geometry::RigidTransform change = rigid(move, middle);
    TouchModel model = kept;
    model.projector_from_tracker = kept.projector_from_tracker * change;
    if (which == Moved::Tracker) {
        model.table_up = glm::conjugate(change.rotation) * kept.table_up;
        model.table_offset_m = kept.height(change.translation);
    }
    return model;
}

ByRigidMove by_move(const TouchModel& model, Moved which) {
    ByRigidMove rows = ByRigidMove::Zero();
    const Eigen::Matrix3d turn = eigen(model.projector_from_tracker.rotation);
    rows.block<3, 3>(turn_x, 0) = turn;
    rows.block<3, 3>(shift_x, 3) = turn;
    if (which == Moved::Tracker) {
        const Eigen::Vector3d up = eigen(model.table_up);
        const Eigen::Matrix<double, 3, 2> axes = table_axes(model.table_up);
        for (int k = 0; k < 2; ++k) {
            rows.block<1, 3>(tilt_a + k, 0) = Eigen::Vector3d(axes.col(k)).cross(up).transpose();
        }
        rows.block<1, 3>(table_height, 3) = up.transpose();
    }
    return rows;
}

} // namespace frustumscreen::calibration
