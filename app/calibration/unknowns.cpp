#include "app/calibration/unknowns.h"

#include <Eigen/Geometry>

namespace frustumscreen::calibration {

Eigen::Matrix<double, 3, 2> table_axes(const glm::dvec3& up) {
    const Eigen::Vector3d n = eigen(up);
    Eigen::Matrix<double, 3, 2> axes;
    axes.col(0) = n.unitOrthogonal();
    axes.col(1) = n.cross(axes.col(0));
    return axes;
}

TouchModel changed(const TouchModel& base, const glm::dvec3& middle, const Changes& change) {
    const ChangedModel<double> now(base, middle, change.data());
    TouchModel model;
    model.pinhole = {.width = base.pinhole.width,
                     .height = base.pinhole.height,
                     .fx = now.fx,
                     .fy = now.fy,
                     .cx = now.cx,
                     .cy = now.cy};
    model.pinhole.lens = {now.k1, now.k2};
    const Eigen::Quaterniond q(now.turn);
    model.projector_from_tracker.rotation = glm::normalize(glm::dquat(q.w(), q.x(), q.y(), q.z()));
    model.projector_from_tracker.translation =
        glm_vector(now.middle_in_j) - model.projector_from_tracker.rotation * middle;
    model.sensor_offset_m = glm_vector(now.offset);
    model.table_up = glm::normalize(glm_vector(now.up));
    model.table_offset_m = now.middle_height - glm::dot(model.table_up, middle);
    model.boards = now.boards;
    return model;
}

} // namespace frustumscreen::calibration
