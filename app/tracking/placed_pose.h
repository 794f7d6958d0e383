/// A tracker's pose, placed on the table for a pose file.
///
/// Threads  pure; any.
#pragma once

#include "app/geometry/transform.h"
#include "firmware_host/tracker/tracker.h"

namespace frustumscreen {

/// Table coordinates of a pose in the device's own frame; one that is not ok has none and stays as it is.
[[nodiscard]] inline PoseSample placed_on_table(PoseSample pose, const RigidTransform& table_from_device) {
    if (pose.ok) {
        const RigidTransform placed = table_from_device * RigidTransform{pose.rotation, pose.position_m};
        pose.position_m = placed.translation;
        pose.rotation = placed.rotation;
    }
    return pose;
}

} // namespace frustumscreen
