/// Motions of the prop in a hand, as closed forms of time. The bench measures the pose estimators on them.
///
/// Frames   table T; metres, radians, seconds since the beginning.
/// Threads  pure once made; any. The same seed gives the same motion.
#pragma once

#include "app/geometry/transform.h"

#include <cstdint>
#include <functional>
#include <span>

namespace frustumscreen {

using HandMotion = std::function<RigidTransform(double t_s)>;

/// Strokes at `speed_m_s`. After 0.10 to 0.25 m each turns round into about the opposite direction. The prop
/// also turns, at 2 rad a metre, and this turn reverses too. The velocity turns along a smooth step whose
/// acceleration is 5 m/s^2 at most.
[[nodiscard]] HandMotion strokes(double speed_m_s, double length_s, std::uint64_t seed);

/// Goes straight along X at `speed_m_s`, brakes at `braking_m_s2` from `brake_at_s` on, then stands still.
[[nodiscard]] HandMotion stop(double speed_m_s, double braking_m_s2, double brake_at_s);

[[nodiscard]] HandMotion rest();

/// One pose of a recording.
struct RecordedPose {
    double t_s = 0.0;
    RigidTransform pose;
};
/// Goes straight from pose to pose, in ascending time; it rests before the first and after the last. The
/// poses must outlive it.
[[nodiscard]] HandMotion recorded(std::span<const RecordedPose> poses);

/// What a hand does, from `begin_s` on, with a prop that it slides on the table: the way since then across Z, and the turn about Z.
[[nodiscard]] HandMotion slid(HandMotion hand, double begin_s);

} // namespace frustumscreen
