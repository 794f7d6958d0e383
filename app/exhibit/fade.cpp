#include "app/exhibit/fade.h"

#include "app/geometry/time_curves.h"

#include <utility>

namespace frustumscreen {

void Fade::change_to(std::size_t which, MonotonicTime now) {
    const Nanoseconds elapsed = now - start_;
    if (elapsed >= each_way_) {
        from_ = std::exchange(to_, which);
        // A fade-in that is not over turns round at the brightness it has reached.
        start_ = elapsed < 2 * each_way_ ? now - (2 * each_way_ - elapsed) : now;
    } else if (which == from_ && to_ != from_) {
        to_ = from_; // still fading out, and wanted again: in from here
        start_ = now - (2 * each_way_ - elapsed);
    } else {
        to_ = which; // still fading out: only the goal is another
    }
}

Faded Fade::at(MonotonicTime now) const {
    const double phase = to_seconds(now - start_) / to_seconds(each_way_);
    if (phase < 1.0) {
        return {from_, 1.0 - ease(phase), true};
    }
    return {to_, ease(phase - 1.0), phase < 2.0};
}

} // namespace frustumscreen
