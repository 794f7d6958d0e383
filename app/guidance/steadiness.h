/// How well a whole picture bears the visitor's next movements: people turn the prop to see its other sides, push it
/// a little, or lean it in the hand. An advice that ends at the edge of the light is soon needed again.
///
/// Threads  pure; any. Allocates nothing.
#pragma once

#include "app/guidance/face_reader.h"

namespace frustumscreen::guidance {

/// Fraction of these small movements after which the picture is still whole. `looks`: incremented by the number of
/// situations examined.
[[nodiscard]] double steadiness(const FaceReader& reader, const GuidedState& tracked_state, int& looks);

} // namespace frustumscreen::guidance
