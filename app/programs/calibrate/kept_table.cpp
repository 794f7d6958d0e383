#include "app/programs/calibrate/kept_table.h"

#include "app/calibration/upright_touches.h"
#include "app/geometry/table_plane.h"

#include <glm/gtc/quaternion.hpp>
#include <glm/gtx/quaternion.hpp>

#include <cmath>
#include <vector>

namespace frustumscreen::programs {

namespace {

const glm::dvec3 up(0.0, 0.0, 1.0);

} // namespace

geometry::RigidTransform settings_from_measured(const settings::ProjectorSettings& projector) {
    const glm::dvec2 middle = 0.5 * glm::dvec2(projector.pinhole.width, projector.pinhole.height);
    const auto lit = [&](const glm::dvec2& pixel) { // checked settings light the table
        return geometry::lights_table(projector.pinhole, projector.table_from_projector, pixel).value();
    };
    const glm::dvec2 origin = lit(middle);
    const glm::dvec2 along_u = lit(middle + glm::dvec2(1.0, 0.0)) - origin;
    return {glm::angleAxis(std::atan2(along_u.y, along_u.x), up), glm::dvec3(origin, 0.0)};
}

geometry::RigidTransform sensor_from_prop(const calibration::CalibratedTable& table,
                                          std::span<const calibration::Touch> touches,
                                          const geometry::RigidTransform& described) {
    const glm::dvec3 up_in_tracker = glm::inverse(table.table_from_tracker.rotation) * up;
    const std::vector<bool> upright = calibration::upright_ones(touches, up_in_tracker);
    glm::dvec3 axis(0.0); // the table's +Z in the sensor
    for (std::size_t k = 0; k < touches.size(); ++k) {
        axis += upright[k] ? glm::inverse(touches[k].tracker_from_sensor.rotation) * up_in_tracker
                           : glm::dvec3(0.0);
    }
    axis = glm::normalize(axis);
    // A sensor that hangs upside down has no unique shortest rotation, so half a turn about its X axis comes
    // first.
    const glm::dquat over(0.0, 1.0, 0.0, 0.0);
    const bool is_opposite = glm::dot(described.rotation * up, axis) < -0.99;
    const glm::dquat rotation = is_opposite ? described.rotation * over : described.rotation;
    return {glm::normalize(glm::rotation(rotation * up, axis) * rotation), table.sensor_offset_m};
}

settings::Calibration kept_table(const calibration::CalibratedTable& table,
                                 const geometry::RigidTransform& sensor_from_prop,
                                 const settings::Settings& settings) {
    const geometry::RigidTransform settings_table = settings_from_measured(settings.projector);
    settings::Calibration kept;
    kept.pinhole = table.pinhole;
    kept.table_from_projector = settings_table * table.table_from_projector;
    kept.registration = settings.tracker.registration; // keeps the eye in the head's sensor
    kept.registration.table_from_tracker = settings_table * table.table_from_tracker;
    kept.registration.sensor_from_prop = sensor_from_prop;
    return kept;
}

settings::Calibration kept_table(const calibration::CalibratedTable& table,
                                 std::span<const calibration::Touch> touches,
                                 const settings::Settings& settings) {
    return kept_table(table, sensor_from_prop(table, touches, settings.tracker.registration.sensor_from_prop),
                      settings);
}

} // namespace frustumscreen::programs
