#include "app/calibration/eye_sight.h"

#include "app/geometry/table_plane.h"

namespace frustumscreen {

std::optional<EyeSights> placed_sights(std::span<const ReportedSight> reported, const Pinhole& pinhole,
                                       const RigidTransform& table_from_projector,
                                       const RigidTransform& table_from_tracker) {
    EyeSights sights;
    for (const ReportedSight& sight : reported) {
        const std::optional<glm::dvec2> cross = lights_table(pinhole, table_from_projector, sight.pixel);
        if (!cross) {
            return std::nullopt;
        }
        sights.push_back({sight.eye, table_from_tracker * sight.tracker_from_sensor, glm::dvec3(*cross, 0.0),
                          sight.tip_m});
    }
    return sights;
}

} // namespace frustumscreen
