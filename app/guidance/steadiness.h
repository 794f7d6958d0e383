/// How well a whole picture bears what a visitor does next: people turn the prop to see its other sides, push it a little, lean
/// it in the hand. Advice that ends at the edge of what is lit is soon needed again.
///
/// Threads  pure; any. Allocates nothing.
#pragma once

#include "app/guidance/face_reader.h"

namespace frustumscreen {

/// The share of these small movements after which the picture is still whole. `looks`: the situations looked at are added to it.
[[nodiscard]] double steadiness(const FaceReader& reader, const GuidedState& tracked_state, int& looks);

} // namespace frustumscreen
