/// Bounds the time of pinned windows: while frames with windows miss their deadline, the windows take one sample a pixel.
///
/// Few      when a frame with windows has taken longer than its deadline, smoothed over `smooth_s`, for `misses`.
/// Many     again when the time has been below `easy_share` of the deadline for `easy`. If that proves too much within `proves`,
///          the next try waits twice as long, up to `max_easy`.
/// Time     `now` never goes back.
/// Threads  values; one caller. Allocates nothing.
#pragma once

#include "firmware_host/base/time.h"

#include <chrono>
#include <optional>

namespace frustumscreen::scene {

class WindowSamples {
public:
    static constexpr double smooth_s = 0.25, easy_share = 0.6;
    static constexpr Nanoseconds misses = std::chrono::milliseconds(300), easy = std::chrono::seconds(3),
                                 proves = std::chrono::seconds(2), max_easy = std::chrono::seconds(60);

    explicit WindowSamples(double deadline_ms) : deadline_ms_(deadline_ms) {}

    /// Call after a frame, which took `ms`; `shows`: a window was in it.
    void record(MonotonicTime now, double ms, bool shows);
    /// True if windows take one sample a pixel.
    [[nodiscard]] bool few() const { return few_; }

private:
    double deadline_ms_;
    double ms_ = 0.0; ///< smoothed
    bool few_ = false;
    Nanoseconds waits_ = easy;
    std::optional<MonotonicTime> last_, since_; ///< since: the time misses the deadline, or is easy
    MonotonicTime many_since_;
};

} // namespace frustumscreen::scene
