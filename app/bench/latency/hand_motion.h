/// How a hand moves the prop, as closed forms of time: what the estimators of poses are measured on.
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

/// Strokes at `speed_m_s`, each turning round into about the opposite direction after 0.10 to 0.25 m, with a
/// turn of the prop that reverses too, at 2 rad a metre. The velocity turns along a smooth step whose
/// acceleration is 5 m/s^2 at most.
[[nodiscard]] HandMotion strokes(double speed_m_s, double length_s, std::uint64_t seed);

/// Straight on at `speed_m_s` along X, braking at `braking_m_s2` from `brake_at_s` on, then still.
[[nodiscard]] HandMotion stop(double speed_m_s, double braking_m_s2, double brake_at_s);

[[nodiscard]] HandMotion rest();

/// One pose of a recording.
struct RecordedPose {
    double t_s = 0.0;
    RigidTransform pose;
};
/// Straight between the poses, in ascending time; the first and the last beyond. The poses must outlive it.
[[nodiscard]] HandMotion recorded(std::span<const RecordedPose> poses);

} // namespace frustumscreen
