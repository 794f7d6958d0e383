#include "app/room/room.h"

#include <cmath>
#include <numbers>

namespace frustumscreen::room {

geometry::RigidTransform table_from_object(const Object& object, double seconds) {
    const Motion& motion = object.motion;
    // Whole turns and periods are taken off first, so that days later the angle is as exact as at the start.
    const double turn = std::fmod(motion.turns_per_minute * seconds / 60.0, 1.0);
    const double sway = std::sin(2.0 * std::numbers::pi * std::fmod(seconds / motion.sway_s, 1.0));
    const double angle = glm::radians(object.turn_deg) + 2.0 * std::numbers::pi * turn;
    return {glm::angleAxis(angle, glm::dvec3(0.0, 0.0, 1.0)), object.place_m + sway * motion.sway_m};
}

} // namespace frustumscreen::room
