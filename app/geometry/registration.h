/// The registration of a tracker: the pose of the device, and of its sensors on the prop and on the head.
///
/// Frames   tracker K, the device's own; table T; prop P; sensor S, whose pose in K the device reports.
///          table_from_prop = table_from_tracker * tracker_from_sensor * sensor_from_prop.
/// Units    metres.
/// Threads  values; any.
#pragma once

#include "app/geometry/transform.h"

namespace frustumscreen::geometry {

struct Registration {
    RigidTransform table_from_tracker{};
    RigidTransform sensor_from_prop{}; ///< of the prop's sensor
    glm::dvec3 eye_in_sensor_m{0.0};   ///< the point between the eyes, in the head's sensor
    /// From the left eye to the right one, in the head's sensor; of any length but 0.
    glm::dvec3 right_in_sensor{1.0, 0.0, 0.0};
    RigidTransform sensor_from_torch{}; ///< of the torch's sensor; the settings' [torch] have it
};

} // namespace frustumscreen::geometry
