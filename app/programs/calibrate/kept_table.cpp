#include "app/programs/calibrate/kept_table.h"

#include <glm/gtc/quaternion.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

namespace frustumscreen {

namespace {

const glm::dvec3 up(0.0, 0.0, 1.0);

/// Where the light of a pixel meets the table.
glm::dvec3 on_table(const ProjectorSettings& projector, const glm::dvec2& pixel) {
    const RigidTransform& pose = projector.table_from_projector;
    const glm::dvec3 ray = pose.direction(projector.pinhole.ray(pixel));
    return pose.translation - ray * (pose.translation.z / ray.z);
}

/// The shortest turn that takes one direction to another; both unit, not opposite.
glm::dquat shortest_turn(const glm::dvec3& from, const glm::dvec3& to) {
    const glm::dvec3 axis = glm::cross(from, to);
    return glm::normalize(glm::dquat(1.0 + glm::dot(from, to), axis.x, axis.y, axis.z));
}

/// The mean of those directions that most others are within ten degrees of: a prop that was laid on a side does not count.
glm::dvec3 most_common(const std::vector<glm::dvec3>& directions) {
    const double near = std::cos(glm::radians(10.0));
    glm::dvec3 best(0.0);
    std::ptrdiff_t most = 0;
    for (const glm::dvec3& each : directions) {
        glm::dvec3 sum(0.0);
        std::ptrdiff_t count = 0;
        for (const glm::dvec3& other : directions) {
            if (glm::dot(each, other) > near) {
                sum += other;
                ++count;
            }
        }
        if (count > most) {
            most = count;
            best = glm::normalize(sum);
        }
    }
    return best;
}

} // namespace

RigidTransform settings_from_measured(const ProjectorSettings& projector) {
    const glm::dvec2 middle = 0.5 * glm::dvec2(projector.pinhole.width, projector.pinhole.height);
    const glm::dvec3 origin = on_table(projector, middle);
    const glm::dvec3 along_u = on_table(projector, middle + glm::dvec2(1.0, 0.0)) - origin;
    return {glm::angleAxis(std::atan2(along_u.y, along_u.x), up), glm::dvec3(origin.x, origin.y, 0.0)};
}

RigidTransform sensor_from_prop(const CalibratedTable& table, std::span<const Touch> touches,
                                const RigidTransform& described) {
    std::vector<glm::dvec3> axes; // the table's +Z in the sensor
    for (const Touch& touch : touches) {
        axes.push_back(glm::inverse(table.table_from_tracker.rotation * touch.tracker_from_sensor.rotation) *
                       up);
    }
    const glm::dvec3 axis = most_common(axes);
    const glm::dvec3 before = described.rotation * up;
    // A sensor that hangs upside down has no shortest turn: half a turn about its X axis comes first.
    const glm::dquat over(0.0, 1.0, 0.0, 0.0);
    const bool is_opposite = glm::dot(before, axis) < -0.99;
    const glm::dquat rotation = is_opposite ? described.rotation * over : described.rotation;
    return {glm::normalize(shortest_turn(rotation * up, axis) * rotation), table.sensor_offset_m};
}

Calibration kept_table(const CalibratedTable& table, std::span<const Touch> touches,
                       const Settings& settings) {
    const RigidTransform settings_table = settings_from_measured(settings.projector);
    Calibration kept;
    kept.pinhole = table.pinhole;
    kept.table_from_projector = settings_table * table.table_from_projector;
    kept.registration = settings.tracker.registration; // the eye in the head's sensor stays
    kept.registration.table_from_tracker = settings_table * table.table_from_tracker;
    kept.registration.sensor_from_prop =
        sensor_from_prop(table, touches, settings.tracker.registration.sensor_from_prop);
    return kept;
}

} // namespace frustumscreen
