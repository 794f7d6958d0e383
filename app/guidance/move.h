/// What a visitor can be asked to do, and what becomes of the situation when they do it: well, or as people do.
///
/// Frames   table T, metres, radians; turns are counter-clockwise seen from above, about the prop's own vertical.
/// Threads  pure; any. Allocates nothing.
#pragma once

#include "app/guidance/face_reader.h"

#include <glm/glm.hpp>

#include <cstdint>
#include <string_view>

namespace frustumscreen {

enum class Action : std::uint8_t { Slide, Turn, SetDown, Upright, ComeRound, Raise, Lower, Wait };
/// As in `frustumscreen guide --json`: slide, turn, set_down, upright, come_round, raise, lower, wait.
[[nodiscard]] std::string_view name_of(Action action);

/// A side of the table: front is -Y, the others go on counter-clockwise seen from above.
enum class Side : std::uint8_t { Front, Right, Back, Left };
[[nodiscard]] std::string_view name_of(Side side);

struct Move {
    Action action = Action::Wait;
    glm::dvec3 by_m{0.0};    ///< slide, raise, lower; set down and upright: there, so far from here
    double turn_rad = 0.0;   ///< turn
    Side side = Side::Front; ///< come round
};

/// Stood up or set down elsewhere than where it is.
[[nodiscard]] inline bool stands_elsewhere(const Move& move) {
    return (move.action == Action::SetDown || move.action == Action::Upright) && move.by_m != glm::dvec3(0.0);
}

/// The same request in other words or amounts: a visitor who follows one follows the other.
[[nodiscard]] bool alike(const Move& a, const Move& b);

/// How a person carries out a request.
struct Execution {
    double amount = 1.0; ///< factor on the way or the angle
    double aside_rad =
        0.0; ///< the way's direction, turned about the vertical; the new yaw of what is stood upright;
             ///< the new place of who comes round
    double raised_rad = 0.0;   ///< the way's direction, raised; in the hand only
    bool about_origin = false; ///< turned about the middle of the bottom; else about the prop's middle
};

/// The situation after the move. What stands on the table stays on it; what is in the hand stays above it.
[[nodiscard]] GuidedState after(const Move& move, const GuidanceSetup& setup, const GuidedState& before,
                                const Execution& execution = {});

/// A prop that leans less than this stands upright, as far as a tracker can tell: 3.4 degrees.
inline constexpr double upright_within_rad = 0.06;
/// The angle between the prop's axis and the vertical.
[[nodiscard]] double tilt_rad(const RigidTransform& table_from_prop);
/// Height of the solid's lowest corner over the table.
[[nodiscard]] double lowest_m(const PropShape& prop, const RigidTransform& table_from_prop);
/// Whether the prop's axis lies over the table. One that is off it already may stay.
[[nodiscard]] bool over_table(const GuidanceSetup& setup, const RigidTransform& table_from_prop);

} // namespace frustumscreen
