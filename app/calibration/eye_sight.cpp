#include "app/calibration/eye_sight.h"

#include "app/geometry/table_plane.h"

namespace frustumscreen::calibration {

std::optional<EyeSights> placed_sights(std::span<const ReportedSight> reported,
                                       const geometry::Pinhole& pinhole,
                                       const geometry::RigidTransform& table_from_projector,
                                       const geometry::RigidTransform& table_from_tracker) {
    EyeSights sights;
    for (const ReportedSight& sight : reported) {
        const std::optional<glm::dvec2> cross =
            geometry::lights_table(pinhole, table_from_projector, sight.pixel);
        if (!cross) {
            return std::nullopt;
        }
        sights.push_back({.eye = sight.eye,
                          .table_from_sensor = table_from_tracker * sight.tracker_from_sensor,
                          .cross_m = glm::dvec3(*cross, 0.0),
                          .tip_m = sight.tip_m});
    }
    return sights;
}

} // namespace frustumscreen::calibration
