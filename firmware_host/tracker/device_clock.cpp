#include "firmware_host/tracker/device_clock.h"

#include <algorithm>
#include <cmath>

namespace frustumscreen::tracker {

namespace {

constexpr double block_ns = 1e9;
/// With fewer blocks (seconds) a slope reflects the delays more than the clock.
constexpr std::size_t fewest_blocks = 4;
/// Quartz is within 1e-4. The limit is much wider, so a slope measured on a busy machine passes, but a clock
/// of another rate does not.
constexpr double max_drift = 0.02;
/// An arrival this much too early, or this much too late for `longest_late`, means that the device's clock
/// jumped.
constexpr double jump_ns = 0.5e9;
constexpr Nanoseconds longest_late = std::chrono::milliseconds(500);
/// A clock that runs this long without a jump is believed. Measuring a wrong rate by its slope takes
/// `fewest_blocks` seconds; a grossly wrong rate makes the clock jump sooner.
constexpr Nanoseconds settled = std::chrono::seconds(6);

} // namespace

void DeviceClock::begin(std::uint32_t tick, MonotonicTime arrival) {
    last_tick_ = tick;
    ticks_ = 0;
    first_arrival_ = arrival;
    late_since_.reset();
    block_count_ = 0;
    block_.reset();
    block_number_ = 0;
    height_ns_ = 0.0; // the drift stays: the quartz has not changed
}

DeviceClock::Point DeviceClock::point_of(std::int64_t ticks, MonotonicTime arrival) const {
    const double device_ns = static_cast<double>(ticks) * tick_ns_;
    return {device_ns, static_cast<double>((arrival - first_arrival_).count()) - device_ns};
}

/// An early arrival is a jump at once. A late one is a jump only after `longest_late`: a stalled transfer is
/// late too, but catches up.
bool DeviceClock::jumped(const Point& point, MonotonicTime arrival) {
    const double above_line = height_of(point) - height_ns_;
    if (above_line <= jump_ns) {
        late_since_.reset();
        return above_line < -jump_ns;
    }
    if (!late_since_) {
        late_since_ = arrival;
    }
    return arrival - *late_since_ > longest_late;
}

void DeviceClock::take(const Point& point) {
    const auto number = static_cast<std::int64_t>(std::floor(point.device_ns / block_ns));
    if (block_ && number != block_number_) {
        blocks_[block_count_ % max_blocks] = *block_;
        ++block_count_;
        block_.reset();
        fit();
    }
    if (!block_ || height_of(point) < height_of(*block_)) {
        block_ = point;
        block_number_ = number;
    }
    height_ns_ = std::min(height_ns_, height_of(point));
}

void DeviceClock::fit() {
    const std::size_t count = std::min(block_count_, max_blocks);
    if (count >= fewest_blocks) {
        std::array<double, max_blocks*(max_blocks - 1) / 2> slopes{};
        std::size_t pairs = 0;
        for (std::size_t a = 1; a < count; ++a) {
            for (std::size_t b = 0; b < a; ++b) {
                const double run = blocks_[a].device_ns - blocks_[b].device_ns;
                slopes[pairs++] = (blocks_[a].late_ns - blocks_[b].late_ns) / run;
            }
        }
        const auto middle = slopes.begin() + static_cast<std::ptrdiff_t>(pairs / 2);
        std::nth_element(slopes.begin(), middle, slopes.begin() + static_cast<std::ptrdiff_t>(pairs));
        drift_ = std::clamp(*middle, -max_drift, max_drift);
        wrong_rate_ = drift_ != *middle;
        // Points measured at a wrong rate must not outvote the next ones.
        block_count_ = wrong_rate_ ? 0 : block_count_;
    }
    height_ns_ = height_of(blocks_[0]);
    for (std::size_t k = 1; k < count; ++k) {
        height_ns_ = std::min(height_ns_, height_of(blocks_[k]));
    }
}

void DeviceClock::restart(std::uint32_t tick, MonotonicTime arrival) {
    restarts_ += believed() ? 1U : 0U; // a clock that is not believed jumps all the time; do not count that
    quick_restarts_ = arrival - first_arrival_ < settled ? quick_restarts_ + 1 : 1;
    begin(tick, arrival);
}

MonotonicTime DeviceClock::line_at(double device_ns) const {
    return first_arrival_ + Nanoseconds(std::llround(device_ns * (1.0 + drift_) + height_ns_));
}

MonotonicTime DeviceClock::time_of(std::uint32_t tick, MonotonicTime arrival) {
    const auto step = static_cast<std::int32_t>(tick - last_tick_); // wraps as the device's tick does
    const bool doubted = !believed();
    bool same = false; // the tick equals the previous one
    if (!last_time_) {
        begin(tick, arrival);
    } else if (step < 0 || jumped(point_of(ticks_ + step, arrival), arrival)) {
        restart(tick, arrival);
    } else {
        ticks_ += step;
        last_tick_ = tick;
        same = step == 0;
        if (arrival - first_arrival_ > settled) {
            quick_restarts_ = 0;
        }
    }
    take(point_of(ticks_, arrival));
    if (doubted && believed()) { // the line was fitted before the clock was believed
        begin(tick, arrival);
        take(point_of(0, arrival));
    }
    if (same && believed()) {
        return *last_time_;
    }
    MonotonicTime time = believed() ? line_at(static_cast<double>(ticks_) * tick_ns_) : arrival;
    if (last_time_ && time <= *last_time_) {
        time = *last_time_ + Nanoseconds(same ? 0 : 1000);
    }
    last_time_ = time;
    return time;
}

} // namespace frustumscreen::tracker
