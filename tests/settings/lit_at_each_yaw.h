/// A place of the upright prop, tried at every degree. Frames: table T, metres.
#pragma once

#include "app/settings/lit_zone.h"

namespace frustumscreen::settings {

[[nodiscard]] inline bool lit_at_each_yaw(const Settings& settings, const glm::dvec2& place,
                                          const glm::dvec3& eye) {
    for (int degree = 0; degree < 360; ++degree) {
        const geometry::RigidTransform pose{glm::angleAxis(glm::radians(1.0 * degree), glm::dvec3(0, 0, 1)),
                                            {place, 0.0}};
        if (!every_seen_face_is_lit(settings, pose, eye)) {
            return false;
        }
    }
    return true;
}

} // namespace frustumscreen::settings
