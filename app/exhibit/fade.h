/// From one thing to another by way of darkness: the old one fades out, the new one in.
///
/// A change of mind in the middle turns the fade round without a jump. Brightness is a closed form of time:
/// nothing is integrated, so a late frame shows what an early one would have.
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
    bool changing = false;   ///< brightness moves
};

class Fade {
public:
    /// `each_way`: how long it takes out, and again in. `which` begins to fade in at `now`.
    Fade(std::size_t which, Nanoseconds each_way, MonotonicTime now)
        : each_way_(each_way), from_(which), to_(which), start_(now - each_way) {}

    void change_to(std::size_t which, MonotonicTime now);
    [[nodiscard]] Faded at(MonotonicTime now) const;
    /// What it fades to, or has.
    [[nodiscard]] std::size_t goal() const { return to_; }

private:
    Nanoseconds each_way_;
    std::size_t from_;
    std::size_t to_;
    MonotonicTime start_; ///< `from_` begins to fade
};

} // namespace frustumscreen
