#include "app/exhibit/hand_fade.h"

#include "app/geometry/time_curves.h"

#include <algorithm>

namespace frustumscreen::exhibit {

double HandFade::level(MonotonicTime now) const {
    const double gone = std::max(0.0, to_seconds(now - since_) / to_seconds(each_way));
    return std::clamp(from_ + (lost_ ? -gone : gone), 0.0, 1.0);
}

double HandFade::at(MonotonicTime now, Nanoseconds age) {
    const bool lost = age >= held;
    if (lost != lost_) {
        // As if a frame had come at exactly the time of the loss.
        const MonotonicTime changed = lost ? now - (age - held) : now;
        from_ = level(changed);
        since_ = changed;
        lost_ = lost;
    }
    return geometry::ease(level(now));
}

} // namespace frustumscreen::exhibit
