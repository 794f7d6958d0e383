/// Keeps what is done with a camera's frames within a share of one core: after a frame that took some time, those that come too soon
/// are passed over. What of the share was left unused while it waited for a frame counts for the next ones, up to `most_credit`: a frame that costs
/// a little too much takes away one of many, and not every other one.
///
/// Time     the frames' own. Where it goes back by much, as another clock's would, the frame is looked at.
/// Threads  one caller: the camera's own thread.
#pragma once

#include "firmware_host/base/time.h"

#include <functional>
#include <optional>

namespace frustumscreen {

/// Of the processor, that this thread has used.
[[nodiscard]] double thread_seconds();

class FramePace {
public:
    static constexpr Nanoseconds most_credit = std::chrono::milliseconds(50);

    /// `busy`: seconds of the processor, ascending.
    explicit FramePace(double most_share, std::function<double()> busy = thread_seconds)
        : most_share_(most_share), busy_(std::move(busy)) {}

    /// Whether the frame of that time is to be looked at; then the look begins.
    [[nodiscard]] bool begin(MonotonicTime frame);
    /// The look has ended; returns the seconds that it took.
    double end();

private:
    double most_share_;
    std::function<double()> busy_;
    double began_s_ = 0.0;
    MonotonicTime frame_;               ///< that is looked at
    std::optional<MonotonicTime> next_; ///< earlier frames are passed over
};

} // namespace frustumscreen
