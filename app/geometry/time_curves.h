/// Closed forms of time that smoothers and fades share: exact for every step, so none of them can ring, run
/// away or depend on the frame rate.
///
/// Units    seconds.
/// Threads  pure; any.
/// Errors   none: time that stands still, goes back or is not a number moves nothing.
#pragma once

namespace frustumscreen {

/// Share of the way to its goal that a first-order follower goes in `dt_s`: 1 - exp(-dt / time constant), the
/// exact solution of x' = (goal - x) / time constant for a goal that stands still meanwhile. Two steps end
/// where one of their sum does. A time constant of 0 or less follows at once.
[[nodiscard]] double follow_share(double dt_s, double time_constant_s);

/// 0 before a fade begins, 1 from `length_s` on, straight between.
[[nodiscard]] double ramp(double elapsed_s, double length_s);

/// Smooth step x^2 (3 - 2 x) of x held within 0..1: begins and ends at rest. Symmetric, ease(1 - x) =
/// 1 - ease(x), which lets a fade turn round without a jump. Its slope is 1.5 at most.
[[nodiscard]] double ease(double x);

} // namespace frustumscreen
