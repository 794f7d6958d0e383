/// How well a tracker sees one of its sensors, over the last second: how many samples come, how many of them can be
/// used, and how much they tremble.
///
/// Noise    the samples' distance from their mean, RMS, and their turn from the mean rotation. It is the noise of a
///          sensor that lies still; if the sensor is moved, it includes the movement.
/// Frames   those of the samples; millimetres and degrees out.
/// Time     `now` never goes back; samples count by their own time.
/// Threads  a value; one caller. Allocates nothing.
#pragma once

#include "firmware_host/tracker/tracker.h"

#include <array>
#include <cstddef>
#include <optional>

namespace frustumscreen::tracking {

struct TrackerSignal {
    double rate_hz = 0.0;                      ///< of all samples
    double usable = 0.0;                       ///< share of them, 0..1
    std::optional<double> noise_mm, noise_deg; ///< none: fewer than `SignalMeter::min_samples` can be used

    [[nodiscard]] bool operator==(const TrackerSignal&) const = default;
};

class SignalMeter {
public:
    static constexpr Nanoseconds window = std::chrono::seconds(1);
    static constexpr std::size_t max_samples =
        512; ///< no tracker sends more in the window; of faster ones the latest count
    static constexpr std::size_t min_samples = 8;

    void take(const tracker::PoseSample& sample);
    [[nodiscard]] TrackerSignal at(MonotonicTime now) const;

private:
    std::array<tracker::PoseSample, max_samples> samples_{}; ///< a ring
    std::size_t count_ = 0;                                  ///< taken since the start
};

} // namespace frustumscreen::tracking
