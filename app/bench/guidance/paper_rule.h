/// The advice of the paper: the single action that opens the unlit face with the largest area on the visitor's screen
/// and keeps the valid faces.
///
/// The paper only moves and rotates, and gives no amounts. This version may also set the prop down or upright, and
/// takes, of all actions that open the face, the one with the least effort.
///
/// Threads  pure; any.
/// Source   Kim, Shin, Kim 2008, 'Guiding the user'.
#pragma once

#include "app/guidance/move.h"

#include <optional>

namespace frustumscreen::bench {

/// Nothing if the situation is valid. The amounts are those of people who are told none: 10 cm, 30 degrees.
[[nodiscard]] std::optional<guidance::Move> paper_advice(const guidance::FaceReader& reader,
                                                         const guidance::GuidedState& tracked_state);

} // namespace frustumscreen::bench
