/// Waits for the end of a burst of changes: an editor that saves, a folder that is copied.
///
/// Time     `now` never decreases.
/// Threads  values; one caller.
#pragma once

#include "firmware_host/base/time.h"

#include <algorithm>
#include <optional>

namespace frustumscreen::programs {

class SettleTime {
public:
    explicit SettleTime(Nanoseconds quiet) : quiet_(quiet) {}

    void changed(MonotonicTime now) { last_ = now; }
    /// Time until the burst is over; nullopt without a change.
    [[nodiscard]] std::optional<Nanoseconds> left(MonotonicTime now) const {
        return last_ ? std::optional(std::max(Nanoseconds(0), quiet_ - (now - *last_))) : std::nullopt;
    }
    /// Returns true once for each burst, when nothing has changed for the quiet time.
    [[nodiscard]] bool take(MonotonicTime now) {
        const bool over = left(now) == Nanoseconds(0);
        last_ = over ? std::nullopt : last_;
        return over;
    }

private:
    Nanoseconds quiet_;
    std::optional<MonotonicTime> last_;
};

} // namespace frustumscreen::programs
