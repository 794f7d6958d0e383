/// From one thing to another by way of darkness: the old one fades out, the new one in.
///
/// Brightness is a closed form of time: nothing is integrated, so a late frame shows what an early one would
/// have. It never jumps, whatever is asked for in the middle.
///
/// Time     `now` never goes back.
/// Threads  values; one caller. `at` is pure.
#pragma once

#include "firmware_host/base/time.h"

#include <cstddef>

namespace frustumscreen {

struct Faded {
    std::size_t which = 0;
    double brightness = 0.0; ///< 0..1, a factor on linear light
    bool changing = false;   ///< brightness moves, or is about to
};

class Fade {
public:
    /// `each_way`: how long it takes out, and again in. `which` begins to fade in at `now`.
    Fade(std::size_t which, Nanoseconds each_way, MonotonicTime now)
        : each_way_(each_way), from_(which), to_(which), in_(now), out_(now - each_way) {}

    /// Begins at `begin`, or later: what fades in comes in wholly first, so however often it is asked,
    /// changes are at least twice `each_way` apart. What is on its way to darkness only gets another goal. A
    /// `begin` before `now` is as if it had been asked for then.
    void change_to(std::size_t which, MonotonicTime now, MonotonicTime begin);
    /// Begins at once: a fade that is not over turns round at the brightness that it has reached. For what
    /// does not change its mind often.
    void turn_to(std::size_t which, MonotonicTime now);
    [[nodiscard]] Faded at(MonotonicTime now) const;
    /// What it fades to, or has.
    [[nodiscard]] std::size_t goal() const { return to_; }

    /// Of the latest change, which may be still to come.
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

} // namespace frustumscreen
