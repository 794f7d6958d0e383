/// Moves that a visitor can be asked for, and the situation after each: carried out well, or as people do.
///
/// Frames   table T, metres, radians; turns are counter-clockwise seen from above, about the prop's own vertical.
/// Threads  pure; any. Allocates nothing.
#pragma once

#include "app/guidance/face_reader.h"

#include <glm/glm.hpp>

#include <cstdint>
#include <string_view>

namespace frustumscreen::guidance {

enum class Action : std::uint8_t { Slide, Turn, SetDown, Upright, ComeRound, Raise, Lower, Wait };
/// As in `frustumscreen guide --json`: slide, turn, set_down, upright, come_round, raise, lower, wait.
[[nodiscard]] std::string_view name_of(Action action);

/// A side of the table: front is -Y, the others follow counter-clockwise seen from above.
enum class Side : std::uint8_t { Front, Right, Back, Left };
[[nodiscard]] std::string_view name_of(Side side);

struct Move {
    Action action = Action::Wait;
    glm::dvec3 by_m{0.0};    ///< slide, raise, lower: the way; set down, upright: offset of the new place
    double turn_rad = 0.0;   ///< turn
    Side side = Side::Front; ///< come round
};

/// True if the move stands or sets the prop down at another place.
[[nodiscard]] inline bool stands_elsewhere(const Move& move) {
    return (move.action == Action::SetDown || move.action == Action::Upright) && move.by_m != glm::dvec3(0.0);
}

/// True if both are the same request in other words or amounts: a visitor who follows one follows the other.
[[nodiscard]] bool alike(const Move& a, const Move& b);

/// The way in which a person carries out a request.
struct Execution {
    double amount = 1.0;       ///< factor on the way or the angle
    double aside_rad = 0.0;    ///< rotation of the way about the vertical; for upright, the new yaw;
                               ///< for come_round, rotation of the new place
    double raised_rad = 0.0;   ///< elevation of the way; in the hand only
    bool about_origin = false; ///< turned about the bottom's middle instead of the prop's middle
};

/// The situation after the move. A prop that stands on the table stays on it; a prop in the hand stays above it.
[[nodiscard]] GuidedState after(const Move& move, const GuidanceSetup& setup, const GuidedState& before,
                                const Execution& execution = {});

/// A prop that leans less than this counts as upright, within a tracker's accuracy: 3.4 degrees.
inline constexpr double upright_within_rad = 0.06;
/// The angle between the prop's axis and the vertical.
[[nodiscard]] double tilt_rad(const geometry::RigidTransform& table_from_prop);
/// Height of the prop's lowest corner over the table.
[[nodiscard]] double lowest_m(const geometry::PropShape& prop,
                              const geometry::RigidTransform& table_from_prop);
/// True if the prop's axis lies over the table. A prop that is already off the table may stay off it.
[[nodiscard]] bool over_table(const GuidanceSetup& setup, const geometry::RigidTransform& table_from_prop);

} // namespace frustumscreen::guidance
