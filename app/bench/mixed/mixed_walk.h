/// A visitor's path through a kiosk's allowed zone at 60 frames a second: the prop is slid and turned, the eye goes around it,
/// comes nearer and goes away.
///
/// Path     sums of slow waves with periods and phases from the seed: continuous, and no faster than a person. Every pose is
///          in the zone of poses.h; the prop stays near the place from which it is lit on all sides that are seen.
/// Frames   table frame, metres.
/// Threads  pure; any. The same settings, length and seed give the same path on every machine.
/// Errors   the settings leave no such path.
#pragma once

#include "app/bench/truth/poses.h"

namespace frustumscreen::bench {

inline constexpr double walk_hz = 60.0;

[[nodiscard]] Result<std::vector<BenchPose>> draw_walk(const settings::Settings& settings,
                                                       const geometry::PropShape& prop, int frames,
                                                       std::uint64_t seed);

} // namespace frustumscreen::bench
