/// The advice for a visitor who carries it out exactly: the single move that ends valid and is quick and steady
/// (steadiness.h), however small its tolerance; otherwise the first of the shortest sequence known. No visitor is that
/// exact; it is the upper bound for advice.
///
/// Threads  pure; any.
#pragma once

#include "app/guidance/move.h"

#include <optional>

namespace frustumscreen::bench {

/// Nothing if the situation is valid.
[[nodiscard]] std::optional<guidance::Move> perfect_advice(const guidance::FaceReader& reader,
                                                           const guidance::GuidedState& tracked_state);

} // namespace frustumscreen::bench
