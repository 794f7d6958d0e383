#include "app/calibration/eye_sight.h"

namespace frustumscreen {

std::optional<EyeSights> placed_sights(std::span<const ReportedSight> reported, const Pinhole& pinhole,
                                       const RigidTransform& table_from_projector,
                                       const RigidTransform& table_from_tracker) {
    EyeSights sights;
    for (const ReportedSight& sight : reported) {
        const glm::dvec3 ray = table_from_projector.direction(pinhole.ray(sight.pixel));
        if (!(ray.z < -1e-3)) {
            return std::nullopt;
        }
        const glm::dvec3& lens = table_from_projector.translation;
        sights.push_back({sight.eye, table_from_tracker * sight.tracker_from_sensor,
                          lens - ray * (lens.z / ray.z), sight.tip_m});
    }
    return sights;
}

} // namespace frustumscreen
