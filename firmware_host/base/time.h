/// Monotonic time in integer nanoseconds; functions take clock readings as parameters.
#pragma once

#include <chrono>
#include <cstdint>

namespace frustumscreen {

using Nanoseconds = std::chrono::nanoseconds;
/// A point on CLOCK_MONOTONIC (or, in a replay, on the recording's own clock).
using MonotonicTime = std::chrono::time_point<std::chrono::steady_clock, Nanoseconds>;

[[nodiscard]] inline MonotonicTime from_microseconds(std::int64_t microseconds) {
    return MonotonicTime(std::chrono::microseconds(microseconds));
}
[[nodiscard]] inline std::int64_t to_microseconds(MonotonicTime time) {
    return std::chrono::duration_cast<std::chrono::microseconds>(time.time_since_epoch()).count();
}
/// The only reading of the monotonic clock; called only by code that paces the exhibit or waits for a device.
[[nodiscard]] inline MonotonicTime monotonic_now() {
    return std::chrono::time_point_cast<Nanoseconds>(std::chrono::steady_clock::now());
}
[[nodiscard]] inline double to_seconds(Nanoseconds duration) {
    return std::chrono::duration<double>(duration).count();
}

} // namespace frustumscreen
