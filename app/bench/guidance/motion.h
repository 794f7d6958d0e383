/// A simulated visitor's movement from one situation to another within a given time, with a smooth start and end.
///
/// Frames   table T, metres, seconds.
/// Threads  pure; any.
#pragma once

#include "app/guidance/move.h"

namespace frustumscreen::bench {

struct Motion {
    guidance::GuidedState from;
    guidance::GuidedState to;
    double lasts_s = 0.0;
    double gone_s = 0.0;

    [[nodiscard]] guidance::GuidedState now() const;
    [[nodiscard]] bool done() const { return gone_s >= lasts_s; }
};

/// Time that people take for a move between two situations.
[[nodiscard]] double time_for_s(const guidance::Move& move, const guidance::GuidedState& from,
                                const guidance::GuidedState& to);

} // namespace frustumscreen::bench
