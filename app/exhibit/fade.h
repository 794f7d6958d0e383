/// Changes from one thing to another through darkness: the old one fades out, the new one in.
///
/// Brightness is a closed form of time: nothing is integrated, so a late frame shows what an early one would
/// have. It never jumps, even if a change is asked for in the middle of another.
///
/// Time     `now` never goes back.
/// Threads  values; one caller. `at` is pure.
#pragma once

#include "firmware_host/base/time.h"

#include <cstddef>

namespace frustumscreen::exhibit {

struct Faded {
    std::size_t which = 0;
    double brightness = 0.0; ///< 0..1, a factor on linear light
    bool changing = false;   ///< brightness changes, or is about to
};

class Fade {
public:
    /// `each_way`: the time to fade out, and again to fade in. `which` begins to fade in at `now`.
    Fade(std::size_t which, Nanoseconds each_way, MonotonicTime now)
        : each_way_(each_way), from_(which), to_(which), in_(now), out_(now - each_way) {}

    /// Begins at `begin` or later: a fade-in is finished first, so changes are at least twice `each_way` apart,
    /// however often they are requested. During a fade-out only the goal changes. A `begin` before `now` acts as if
    /// the change had been requested at that time.
    void change_to(std::size_t which, MonotonicTime now, MonotonicTime begin);
    /// Begins at once: a running fade reverses at the brightness that it has reached. Use it only for rare changes.
    void turn_to(std::size_t which, MonotonicTime now);
    [[nodiscard]] Faded at(MonotonicTime now) const;
    /// The thing that it fades to or already shows.
    [[nodiscard]] std::size_t goal() const { return to_; }

    /// When the latest change begins; it may lie in the future.
    [[nodiscard]] MonotonicTime begins() const { return out_; }
    [[nodiscard]] MonotonicTime dark() const { return out_ + each_way_; }
    [[nodiscard]] MonotonicTime ends() const { return out_ + 2 * each_way_; }

private:
    Nanoseconds each_way_;
    std::size_t from_;
    std::size_t to_;
    MonotonicTime in_;  ///< `from_` began to fade in
    MonotonicTime out_; ///< `from_` begins to fade out
};

} // namespace frustumscreen::exhibit
