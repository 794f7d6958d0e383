/// Maps a device's clock (a timestamp or a frame counter) to the monotonic clock.
///
/// Units    ticks of the device; nanoseconds.
/// Threads  one caller; allocates nothing.
/// Errors   none. After a jump of the device's clock the fit restarts. A clock that runs at another rate, or
///          stands still, is not believed: times are then the arrival times, until the clock has run
///          correctly for some seconds.
/// Method   Every arrival is late by at least the shortest delay through device and USB, so the lower
///          envelope of the points (device time, arrival) is the clock. Its slope, the drift, is the median
///          of the slopes between the earliest arrivals of each second (Theil 1950; Sen 1968); its height is
///          the lowest point's. One late transfer, or a second of them, moves neither. A constant delay, the
///          device's own latency, cannot be measured here.
#pragma once

#include "firmware_host/base/time.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

namespace frustumscreen::tracker {

class DeviceClock {
public:
    explicit DeviceClock(double tick_ns) : tick_ns_(tick_ns) {}

    /// The device's `tick` as monotonic time. Times ascend with the ticks; while the clock is believed, equal
    /// ticks give equal times.
    [[nodiscard]] MonotonicTime time_of(std::uint32_t tick, MonotonicTime arrival);
    /// Seconds of our clock per second of the device's, minus 1; 0 during the first seconds.
    [[nodiscard]] double drift() const { return drift_; }
    /// How often the device's clock jumped.
    [[nodiscard]] std::uint64_t restarts() const { return restarts_; }
    [[nodiscard]] bool believed() const { return !wrong_rate_ && quick_restarts_ < max_quick_restarts; }

private:
    struct Point {
        double device_ns = 0.0; ///< since the first tick
        double late_ns = 0.0;   ///< arrival minus device time, both since the first tick
    };
    static constexpr std::size_t max_blocks = 32;
    static constexpr int max_quick_restarts = 3;

    void begin(std::uint32_t tick, MonotonicTime arrival);
    void restart(std::uint32_t tick, MonotonicTime arrival);
    [[nodiscard]] MonotonicTime line_at(double device_ns) const;
    [[nodiscard]] Point point_of(std::int64_t ticks, MonotonicTime arrival) const;
    [[nodiscard]] bool jumped(const Point& point, MonotonicTime arrival);
    void take(const Point& point);
    void fit();
    [[nodiscard]] double height_of(const Point& point) const {
        return point.late_ns - drift_ * point.device_ns;
    }

    double tick_ns_;
    std::uint32_t last_tick_ = 0;
    std::int64_t ticks_ = 0; ///< since the first tick, without wrapping
    MonotonicTime first_arrival_;
    std::optional<MonotonicTime> late_since_;
    std::optional<MonotonicTime> last_time_; ///< last answer; none before the first tick
    std::array<Point, max_blocks> blocks_{}; ///< earliest arrival of each second; a ring
    std::size_t block_count_ = 0;            ///< blocks completed since the last restart
    std::optional<Point> block_;             ///< earliest arrival of the current second
    std::int64_t block_number_ = 0;
    double drift_ = 0.0;
    double height_ns_ = 0.0;
    std::uint64_t restarts_ = 0;
    int quick_restarts_ = 0;  ///< consecutive restarts, each soon after the previous one
    bool wrong_rate_ = false; ///< the fitted slope is out of range
};

} // namespace frustumscreen::tracker
