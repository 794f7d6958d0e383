#include "app/scene/window_samples.h"

#include "app/geometry/time_curves.h"

#include <algorithm>
#include <cmath>

namespace frustumscreen::scene {

void WindowSamples::record(MonotonicTime now, double ms, bool shows) {
    if (!shows || !std::isfinite(ms)) {
        last_.reset();
        since_.reset();
        return;
    }
    const double share = last_ ? geometry::follow_share(to_seconds(now - *last_), smooth_s) : 1.0;
    ms_ += share * (ms - ms_);
    last_ = now;
    const bool counts = few_ ? ms_ < easy_share * deadline_ms_ : ms_ > deadline_ms_;
    if (!counts) {
        since_.reset();
        return;
    }
    since_ = since_.value_or(now);
    if (now - *since_ < (few_ ? waits_ : misses)) {
        return;
    }
    if (!few_ && now - many_since_ < proves) {
        waits_ = std::min(2 * waits_, max_easy);
    }
    few_ = !few_;
    many_since_ = now;
    since_.reset();
}

} // namespace frustumscreen::scene
