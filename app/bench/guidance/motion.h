/// A movement of a simulated visitor that is under way: from one situation to another in a time, begun and ended gently.
///
/// Frames   table T, metres, seconds.
/// Threads  pure; any.
#pragma once

#include "app/guidance/move.h"

namespace frustumscreen {

struct Motion {
    GuidedSituation from;
    GuidedSituation to;
    double lasts_s = 0.0;
    double gone_s = 0.0;

    [[nodiscard]] GuidedSituation now() const;
    [[nodiscard]] bool done() const { return gone_s >= lasts_s; }
};

/// How long people take for a move that leads from one situation to the other.
[[nodiscard]] double time_for_s(const Move& move, const GuidedSituation& from, const GuidedSituation& to);

} // namespace frustumscreen
