/// Closed forms of time for smoothers and fades: exact for every step, so that none of them can ring, diverge
/// or depend on the frame rate.
///
/// Units    seconds.
/// Threads  pure; any.
/// Errors   none: time that stands still, goes back or is not a number changes nothing.
#pragma once

namespace frustumscreen::geometry {

/// Share of the way to its goal that a first-order follower covers in `dt_s`: 1 - exp(-dt / time constant),
/// the exact solution of x' = (goal - x) / time constant for a constant goal. Two steps end where one step of
/// their sum ends. A time constant of 0 or less follows at once.
[[nodiscard]] double follow_share(double dt_s, double time_constant_s);

/// 0 before a fade begins, 1 from `length_s` on, linear in between.
[[nodiscard]] double ramp(double elapsed_s, double length_s);

/// Smooth step x^2 (3 - 2 x) of x clamped to 0..1, with slope 0 at both ends. Symmetric, ease(1 - x) = 1 -
/// ease(x), so that a fade can reverse without a jump. Its slope is at most 1.5.
[[nodiscard]] double ease(double x);

} // namespace frustumscreen::geometry
