/// Lowers short peaks of a sound, and leaves the rest as it is.
///
/// A look-ahead limiter: the gain that a peak needs holds for 5 ms on both sides of it, and is averaged over as much, so that it goes
/// down before the peak and comes back after it without a click.
///
/// Units    full scale is 1.
/// Threads  pure; any.
#pragma once

#include <span>
#include <vector>

namespace frustumscreen {

/// No sample of the result is above `most`, which is positive.
[[nodiscard]] std::vector<float> limit_peaks(std::span<const float> samples, int rate_hz, float most);

} // namespace frustumscreen
