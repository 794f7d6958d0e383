/// Motions of the prop in a hand, as closed forms of time. The bench measures the pose estimators on them.
///
/// Frames   table T; metres, radians, seconds since the beginning.
/// Threads  pure once made; any. The same seed gives the same motion.
#pragma once

#include "app/geometry/transform.h"

#include <cstdint>
#include <functional>
#include <span>

namespace frustumscreen::bench {

using HandMotion = std::function<geometry::RigidTransform(double t_s)>;

/// Strokes at `speed_m_s`. After 0.10 to 0.25 m each stroke turns into roughly the opposite direction. The
/// prop also rotates at 2 rad per metre; each turn reverses this rotation. The velocity changes along a
/// smooth step with at most 5 m/s^2.
[[nodiscard]] HandMotion strokes(double speed_m_s, double length_s, std::uint64_t seed);

/// Moves straight along X at `speed_m_s`, brakes at `braking_m_s2` from `brake_at_s` on, then stands still.
[[nodiscard]] HandMotion stop(double speed_m_s, double braking_m_s2, double brake_at_s);

[[nodiscard]] HandMotion rest();

/// One pose of a recording.
struct RecordedPose {
    double t_s = 0.0;
    geometry::RigidTransform pose;
};
/// Interpolates linearly from pose to pose, in ascending time; at rest before the first pose and after the
/// last. The poses must outlive the motion.
[[nodiscard]] HandMotion recorded(std::span<const RecordedPose> poses);

/// The part of `hand` after `begin_s` that a prop sliding on the table can follow: the displacement since
/// then in the table's plane, and the rotation about Z.
[[nodiscard]] HandMotion slid(HandMotion hand, double begin_s);

} // namespace frustumscreen::bench
