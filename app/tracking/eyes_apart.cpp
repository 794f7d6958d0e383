#include "app/tracking/eyes_apart.h"

#include "app/geometry/time_curves.h"

#include <algorithm>

namespace frustumscreen::tracking {

double EyesApart::follow(MonotonicTime time, bool both) {
    const MonotonicTime before = last_.value_or(time);
    const double step = geometry::ramp(to_seconds(time - before), to_seconds(each_way));
    way_ = std::clamp(way_ + (both ? step : -step), 0.0, 1.0);
    last_ = std::max(before, time);
    return geometry::ease(way_);
}

} // namespace frustumscreen::tracking
