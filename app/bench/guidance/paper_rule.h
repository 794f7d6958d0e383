/// The advice of the paper: the one action that opens the unlit face with the largest area on the visitor's screen, with
/// the faces that are valid kept.
///
/// The paper has moving and rotating alone, and says no amounts. It gets more here: also setting down and standing
/// upright, and of all actions that open the face the one that does so with the least effort.
///
/// Threads  pure; any.
/// Source   Kim, Shin, Kim 2008, 'Guiding the user'.
#pragma once

#include "app/guidance/move.h"

#include <optional>

namespace frustumscreen {

/// Nothing if the situation is valid. The amounts are those that people take who were told none: 10 cm, 30 degrees.
[[nodiscard]] std::optional<Move> paper_advice(const FaceReader& reader, const GuidedSituation& situation);

} // namespace frustumscreen
