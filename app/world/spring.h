/// The law of a damped spring, solved exactly: x'' = -stiffness x - damping x', with x from where it rests.
///
/// A motion is taken from an event to any later time in one evaluation, so steps between add no error, and neither
/// the stiffness nor the step can make it unstable. Below, at and above critical damping it is one formula:
///     x(t) = x C + (v + b x) S,   v(t) = v C - (stiffness x + b v) S,   b = damping / 2,
///     C = exp(-b t) cosh(w t),    S = exp(-b t) sinh(w t) / w,          w^2 = b^2 - stiffness,
/// where cosh and sinh are cos and sin for negative w^2, and S is t exp(-b t) for w = 0, to which both tend.
///
/// Units    seconds; x in anything, radians or a length.
/// Errors   none.
/// Threads  pure; any.
/// Source   a damped harmonic oscillator.
#pragma once

namespace frustumscreen::world {

struct SpringLaw {
    double stiffness_per_s2 = 1.0; ///< above 0
    double damping_per_s = 0.0;    ///< 0 or more
};

struct Motion {
    double x = 0.0;
    double v = 0.0; ///< a second
};

/// `seconds` later; for 0 and less, `motion` itself.
[[nodiscard]] Motion motion_after(const SpringLaw& law, const Motion& motion, double seconds);

/// The distance of an undamped swing with the motion's energy: it is never exceeded, and never grows.
[[nodiscard]] double swing_of(const SpringLaw& law, const Motion& motion);

/// The speed that, from rest, makes a first swing of exactly `x`, damping counted.
[[nodiscard]] double speed_to_reach(const SpringLaw& law, double x);

} // namespace frustumscreen::world
