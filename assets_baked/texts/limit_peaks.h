/// Lowers short peaks of a sound, and leaves the rest unchanged.
///
/// A look-ahead limiter: the gain that a peak needs is held for 5 ms on both sides of it, and averaged over
/// an equal length, so that it falls before the peak and returns after it without a click.
///
/// Units    full scale is 1.
/// Threads  pure; any.
#pragma once

#include <span>
#include <vector>

namespace frustumscreen::texts {

/// No sample of the result is above `most`, which is positive.
[[nodiscard]] std::vector<float> limit_peaks(std::span<const float> samples, int rate_hz, float most);

} // namespace frustumscreen::texts
