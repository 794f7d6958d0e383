/// Whether somebody is still at the table: how long ago the latest press was, or the beginning.
///
/// Time     a parameter.
/// Threads  values; one caller.
#pragma once

#include "firmware_host/base/time.h"

#include <optional>

namespace frustumscreen {

class LastPress {
public:
    /// `is_pressed`: just now; the first call is the beginning.
    [[nodiscard]] bool is_older_than(Nanoseconds patience, MonotonicTime now, bool is_pressed) {
        if (!latest_ || is_pressed) {
            latest_ = now;
        }
        return now - *latest_ > patience;
    }
    /// Something else than a press that tells of somebody.
    void renew(MonotonicTime now) { latest_ = now; }

private:
    std::optional<MonotonicTime> latest_;
};

} // namespace frustumscreen
