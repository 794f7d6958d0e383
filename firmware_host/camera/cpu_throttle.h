/// CPU throttle: keeps the processing of a camera's frames within a share of one core. After a frame that
/// took some time, frames that come too soon are skipped. Unused processor time accumulates as credit, up to
/// `max_credit`, so a frame that costs slightly too much skips one frame in many, not every second one.
///
/// Time     the frames' own. A frame whose time is much earlier, as with another clock, is processed.
/// Threads  one caller: the camera's own thread.
#pragma once

#include "firmware_host/base/time.h"

#include <functional>
#include <optional>

namespace frustumscreen::camera {

/// Processor time used by this thread.
[[nodiscard]] double thread_seconds();

class CpuThrottle {
public:
    static constexpr Nanoseconds max_credit = std::chrono::milliseconds(50);

    /// `busy` returns used processor time in seconds, ascending.
    explicit CpuThrottle(double max_share, std::function<double()> busy = thread_seconds)
        : max_share_(max_share), busy_(std::move(busy)) {}

    /// Whether to process the frame of that time; if so, the processing begins now.
    [[nodiscard]] bool begin(MonotonicTime frame);
    /// The processing has ended; returns its seconds.
    double end();

private:
    double max_share_;
    std::function<double()> busy_;
    double began_s_ = 0.0;
    MonotonicTime frame_;               ///< the frame that is being processed
    std::optional<MonotonicTime> next_; ///< skip frames before this time
};

} // namespace frustumscreen::camera
