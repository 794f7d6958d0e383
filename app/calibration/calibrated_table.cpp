#include "app/calibration/calibrated_table.h"

namespace frustumscreen::calibration {

std::optional<CalibratedTable> in_table_frame(const TouchModel& model) {
    const glm::dvec2 middle(0.5 * model.pinhole.width, 0.5 * model.pinhole.height);
    const double step =
        1e-4 * model.pinhole.width; // central differences: error 1e-8 of the picture's curvature
    const std::optional<glm::dvec3> origin = model.lit(middle, 0.0);
    const std::optional<glm::dvec3> left = model.lit(middle - glm::dvec2(step, 0.0), 0.0);
    const std::optional<glm::dvec3> right = model.lit(middle + glm::dvec2(step, 0.0), 0.0);
    if (!origin || !left || !right) {
        return std::nullopt;
    }
    const glm::dvec3 along = *right - *left;
    const glm::dvec3 x = glm::normalize(along - glm::dot(along, model.table_up) * model.table_up);
    const glm::dmat3 tracker_from_table(x, glm::cross(model.table_up, x), model.table_up);
    geometry::RigidTransform table_from_tracker;
    table_from_tracker.rotation = glm::conjugate(glm::normalize(glm::quat_cast(tracker_from_table)));
    table_from_tracker.translation = -(table_from_tracker.rotation * *origin);
    return CalibratedTable{.pinhole = model.pinhole,
                           .table_from_projector =
                               table_from_tracker * model.projector_from_tracker.inverse(),
                           .table_from_tracker = table_from_tracker,
                           .sensor_offset_m = model.sensor_offset_m};
}

} // namespace frustumscreen::calibration
