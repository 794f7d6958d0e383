/// Predicts a screen's refreshes from the latest observed flip, in steps of the mode's period.
///
/// Time     CLOCK_MONOTONIC.
/// Threads  values.
#pragma once

#include "firmware_host/base/time.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace frustumscreen::display {

class FlipClock {
public:
    FlipClock() = default;
    explicit FlipClock(double refresh_hz)
        : period_(static_cast<Nanoseconds::rep>(std::llround(1e9 / refresh_hz))) {}

    [[nodiscard]] Nanoseconds period() const { return period_; }
    void flipped(MonotonicTime time) { last_ = time; }
    [[nodiscard]] bool known() const { return last_.has_value() && period_ > Nanoseconds(0); }
    /// The first refresh later than `time`; `time` itself before the first flip.
    [[nodiscard]] MonotonicTime first_after(MonotonicTime time) const {
        if (!known()) {
            return time;
        }
        const Nanoseconds since = time - *last_;
        Nanoseconds::rep refreshes = since / period_;
        refreshes += since >= Nanoseconds(0) ? 1 : 0;
        return *last_ + refreshes * period_;
    }
    /// The refresh nearest to `time` + `period`, but at least one refresh after the one nearest to `time`.
    [[nodiscard]] MonotonicTime next_frame(MonotonicTime time, Nanoseconds period) const {
        if (!known()) {
            return time + period;
        }
        const Nanoseconds half = period_ / 2;
        const auto steps = std::max<Nanoseconds::rep>((period + half) / period_, 1);
        return first_after(time - half) + steps * period_;
    }

private:
    Nanoseconds period_{0};
    std::optional<MonotonicTime> last_;
};

} // namespace frustumscreen::display
