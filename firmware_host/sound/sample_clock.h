/// Counts the samples that a clock makes due: whole samples since its start, so rounding errors do not add
/// up.
///
/// Time     a parameter, monotonic; an earlier time makes nothing due.
/// Threads  a value; one caller.
#pragma once

#include "firmware_host/sound/prompt.h"

#include <algorithm>

namespace frustumscreen::sound {

class SampleClock {
public:
    explicit SampleClock(MonotonicTime start) : start_(start) {}

    /// Samples that became due since the last call.
    [[nodiscard]] std::uint64_t take_due(MonotonicTime now) {
        const std::uint64_t due = samples_in(std::max(now - start_, Nanoseconds(0)));
        const std::uint64_t more = due > taken_ ? due - taken_ : 0;
        taken_ += more;
        return more;
    }

private:
    MonotonicTime start_;
    std::uint64_t taken_ = 0;
};

} // namespace frustumscreen::sound
