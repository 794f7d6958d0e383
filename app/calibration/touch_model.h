/// The model that touches determine: the projector, the table and the sensor's offset in the prop, in the
/// tracker's frame.
///
/// Frames   K, the tracker's own; J, the projector's. calibrated_table.h converts it to the table's frame.
/// Units    metres, pixels.
/// Threads  values; any.
#pragma once

#include "app/geometry/pinhole.h"
#include "app/geometry/transform.h"

namespace frustumscreen::calibration {

struct TouchModel {
    geometry::Pinhole pinhole;
    geometry::RigidTransform projector_from_tracker;
    glm::dvec3 sensor_offset_m{0.0};    ///< the touched place in the sensor's frame
    glm::dvec3 table_up{0.0, 0.0, 1.0}; ///< unit, in K
    double table_offset_m = 0.0;        ///< height above the table = dot(table_up, x) + table_offset_m
    double boards = 1.0;                ///< true over given height of the boards

    /// True height of boards of nominal height `block_m`.
    [[nodiscard]] double raised(double block_m) const { return boards * block_m; }

    [[nodiscard]] glm::dvec3 touched(const geometry::RigidTransform& tracker_from_sensor) const {
        return tracker_from_sensor.point(sensor_offset_m);
    }
    [[nodiscard]] double height(const glm::dvec3& tracker_point) const {
        return glm::dot(table_up, tracker_point) + table_offset_m;
    }
    [[nodiscard]] std::optional<glm::dvec2> pixel(const glm::dvec3& tracker_point) const {
        return pinhole.pixel(projector_from_tracker.point(tracker_point));
    }
    /// Where a pixel's light falls at a height above the table; nothing if it does not reach that height.
    [[nodiscard]] std::optional<glm::dvec3> lit(const glm::dvec2& pixel, double height_m) const;
};

} // namespace frustumscreen::calibration
