/// Maps a device's clock (a timestamp or a frame counter) to the monotonic clock.
///
/// Units    ticks of the device; nanoseconds.
/// Threads  one caller; allocates nothing.
/// Errors   none. A clock that jumps is fitted anew. One that runs at another rate, or stands still, is not
///          believed: then a time is that of the arrival, until the clock has run as it should for some
///          seconds.
/// Method   Every arrival is late by at least the shortest way through device and USB, so the line under the
///          points (device time, arrival) is the clock. Its slope, the drift, is the median of the slopes
///          between the earliest arrivals of each second (Theil 1950; Sen 1968), its height the lowest
///          point's: one late transfer, or a second of them, moves neither. A delay that is the same for
///          every frame, the device's own latency, cannot be seen here.
#pragma once

#include "firmware_host/base/time.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

namespace frustumscreen {

class DeviceClock {
public:
    explicit DeviceClock(double tick_ns) : tick_ns_(tick_ns) {}

    /// The device's `tick` in our time. It ascends with the ticks; while the clock is believed, the same tick
    /// gives the same time.
    [[nodiscard]] MonotonicTime time_of(std::uint32_t tick, MonotonicTime arrival);
    /// Our seconds for each of the device's, minus 1; 0 until some seconds were seen.
    [[nodiscard]] double drift() const { return drift_; }
    /// How often the device's clock jumped.
    [[nodiscard]] std::uint64_t restarts() const { return restarts_; }
    [[nodiscard]] bool believed() const { return !wrong_rate_ && quick_restarts_ < most_quick_restarts; }

private:
    struct Point {
        double device_ns = 0.0; ///< since the first tick
        double late_ns = 0.0;   ///< arrival minus device time, both since the first
    };
    static constexpr std::size_t most_blocks = 32;
    static constexpr int most_quick_restarts = 3;

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
    std::int64_t ticks_ = 0; ///< since the first, without wrapping
    MonotonicTime first_arrival_;
    std::optional<MonotonicTime> late_since_;
    std::optional<MonotonicTime> last_time_;  ///< what was answered last; none before the first tick
    std::array<Point, most_blocks> blocks_{}; ///< earliest arrival of each second; a ring
    std::size_t block_count_ = 0;             ///< so far
    std::optional<Point> block_;              ///< of the current second
    std::int64_t block_number_ = 0;
    double drift_ = 0.0;
    double height_ns_ = 0.0;
    std::uint64_t restarts_ = 0;
    int quick_restarts_ = 0;  ///< in a row, each soon after the one before
    bool wrong_rate_ = false; ///< by its slope
};

} // namespace frustumscreen
