/// The advice for a visitor who carries out exactly what is asked: the single move that ends valid and is quick and
/// steady (steadiness.h), however narrow its way; else the first of the shortest sequence known. No visitor is like this; it shows what is left to win.
///
/// Threads  pure; any.
#pragma once

#include "app/guidance/move.h"

#include <optional>

namespace frustumscreen {

/// Nothing if the situation is valid.
[[nodiscard]] std::optional<Move> perfect_advice(const FaceReader& reader, const GuidedSituation& situation);

} // namespace frustumscreen
