#include "app/exhibit/fade.h"

#include "app/geometry/time_curves.h"

#include <algorithm>
#include <utility>

namespace frustumscreen::exhibit {

void Fade::change_to(std::size_t which, MonotonicTime now, MonotonicTime begin) {
    if (now < out_ && which == from_) {
        to_ = from_; // the change had not begun: the current one stays
        out_ = in_ - each_way_;
    } else if (now < dark()) {
        to_ = which;
    } else {
        in_ = dark();
        from_ = std::exchange(to_, which);
        out_ = std::max(begin, in_ + each_way_);
    }
}

void Fade::turn_to(std::size_t which, MonotonicTime now) {
    const Nanoseconds elapsed = now - out_;
    if (elapsed >= each_way_) {
        from_ = std::exchange(to_, which);
        // An unfinished fade-in reverses at the brightness that it has reached.
        out_ = now < ends() ? now - (ends() - now) : now;
    } else if (which == from_ && to_ != from_) {
        to_ = from_; // fading out, but wanted again: fade in from here
        out_ = now - (ends() - now);
    } else {
        to_ = which; // still fading out: only the goal changes
    }
}

Faded Fade::at(MonotonicTime now) const {
    const auto share = [&](MonotonicTime since) {
        return geometry::ease(to_seconds(now - since) / to_seconds(each_way_));
    };
    if (now < out_) {
        return {from_, share(in_), true};
    }
    if (now < dark()) {
        return {from_, 1.0 - share(out_), true};
    }
    return {to_, share(dark()), now < ends()};
}

} // namespace frustumscreen::exhibit
