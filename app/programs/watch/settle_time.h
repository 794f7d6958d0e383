/// Waits until a burst of changes is over: an editor that saves, a folder that is copied.
///
/// Time     `now` never goes back.
/// Threads  values; one caller.
#pragma once

#include "firmware_host/base/time.h"

#include <algorithm>
#include <optional>

namespace frustumscreen {

class SettleTime {
public:
    explicit SettleTime(Nanoseconds quiet) : quiet_(quiet) {}

    void changed(MonotonicTime now) { last_ = now; }
    /// How long to wait until it is over; nothing if nothing has changed.
    [[nodiscard]] std::optional<Nanoseconds> left(MonotonicTime now) const {
        return last_ ? std::optional(std::max(Nanoseconds(0), quiet_ - (now - *last_))) : std::nullopt;
    }
    /// True once for each burst, when nothing has changed for the quiet time.
    [[nodiscard]] bool take(MonotonicTime now) {
        const bool over = left(now) == Nanoseconds(0);
        last_ = over ? std::nullopt : last_;
        return over;
    }

private:
    Nanoseconds quiet_;
    std::optional<MonotonicTime> last_;
};

} // namespace frustumscreen
