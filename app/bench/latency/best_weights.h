/// A lower bound for the error of linear prediction on a recording: the weighted sum of the latest samples, with
/// weights fitted to the same motion that is then measured. No causal linear filter with that memory is better,
/// whatever its model; the exhibit cannot have these weights, because they need the truth.
///
/// Method   least squares of the true pose when the picture is lit, relative to the latest sample, on the differences of
///          the earlier ones to it and on their products with the time ahead; place and turn apart, axes alike.
/// Frames   those of the poses; turns are rotation vectors from the latest sample.
/// Threads  pure; any.
#pragma once

#include "app/bench/latency/latency.h"

#include <span>
#include <vector>

namespace frustumscreen::bench {

/// `samples`: as the tracker sends them, with its noise.
[[nodiscard]] std::vector<LitPicture> pictures_by_best_weights(std::span<const RecordedPose> samples,
                                                               const HandMotion& truth, double length_s,
                                                               const TrackedBy& tracker,
                                                               const LatencySetting& setting);

} // namespace frustumscreen::bench
