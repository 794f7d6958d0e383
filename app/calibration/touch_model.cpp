#include "app/calibration/touch_model.h"

namespace frustumscreen::calibration {

std::optional<glm::dvec3> TouchModel::lit(const glm::dvec2& pixel, double height_m) const {
    const geometry::RigidTransform tracker_from_projector = projector_from_tracker.inverse();
    const glm::dvec3 along = tracker_from_projector.direction(pinhole.ray(pixel));
    const double steep = glm::dot(table_up, along);
    const double way = (height_m - height(tracker_from_projector.translation)) / steep;
    return steep < 0.0 && way > 0.0 ? std::optional(tracker_from_projector.translation + way * along)
                                    : std::nullopt;
}

} // namespace frustumscreen::calibration
