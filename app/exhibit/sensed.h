/// Losses of the tracker that a visitor could correct: a covered prop, metal, a head that is lost.
///
/// A head is missed only if its owner is still present: it was known in this visit, and the prop was touched since
/// the head was lost. A visitor who leaves is not asked to come back.
///
/// Time     `now` never goes back.
/// Threads  values; one caller. Allocates nothing.
#pragma once

#include "app/guidance/guide.h"
#include "app/tracking/tracked_state.h"

#include <optional>

namespace frustumscreen::exhibit {

class Sensed {
public:
    /// `lost`: the prop's pose has been unknown for a while. `touched`: when the prop last moved or a button was
    /// pressed.
    [[nodiscard]] guidance::Sensing update(MonotonicTime now, const tracking::TrackedState& tracked_state,
                                           bool lost, const std::optional<MonotonicTime>& touched);
    /// Forgets the visitor, who has gone.
    void forget() { *this = {}; }

private:
    bool head_seen_ = false;
    std::optional<MonotonicTime> head_lost_;
};

} // namespace frustumscreen::exhibit
