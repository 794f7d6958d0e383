#include "app/room/room.h"

#include <cmath>
#include <numbers>

namespace frustumscreen::room {

geometry::RigidTransform table_from_object(const Object& object, double seconds) {
    const Motion& motion = object.motion;
    // Whole turns and periods are taken off exactly, so that days later the place is as exact as at the start.
    const double turned = motion.turns_per_minute * seconds; // times 60
    const double rounded_off = std::fma(motion.turns_per_minute, seconds, -turned);
    const double turn = (std::fmod(turned, 60.0) + rounded_off) / 60.0;
    const double period = std::fmod(seconds, motion.sway_s) / motion.sway_s;
    const double sway = std::sin(2.0 * std::numbers::pi * period);
    const double angle = glm::radians(object.turn_deg) + 2.0 * std::numbers::pi * turn;
    return {glm::angleAxis(angle, glm::dvec3(0.0, 0.0, 1.0)), object.place_m + sway * motion.sway_m};
}

} // namespace frustumscreen::room
