/// What the tracker does not know and a visitor could mend: a covered prop, metal, a head that is not seen any more.
///
/// A head is missed only by somebody who is there without it: it was known in this visit, and the prop was touched since it was
/// lost. Whoever goes is not asked to come back.
///
/// Time     `now` never goes back.
/// Threads  values; one caller. Allocates nothing.
#pragma once

#include "app/guidance/guide.h"
#include "app/tracking/tracked_state.h"

#include <optional>

namespace frustumscreen {

class Sensed {
public:
    /// `lost`: the prop's place has not been known for a while. `touched`: when the prop moved last or a button was pressed.
    [[nodiscard]] Sensing update(MonotonicTime now, const TrackedState& tracked_state, bool lost,
                                 const std::optional<MonotonicTime>& touched);
    /// The visitor has gone.
    void forget() { *this = {}; }

private:
    bool head_seen_ = false;
    std::optional<MonotonicTime> head_lost_;
};

} // namespace frustumscreen
