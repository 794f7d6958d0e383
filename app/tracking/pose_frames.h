/// The frames that an offline picture run makes of a pose file: one for every time at which the prop has a
/// pose.
///
/// Frames   table T, metres; neither filtered nor predicted. Ascending, unique times; of several usable rows
///          with the same time and station the first counts. The eye is the head's row of the same time, else
///          the default eye. Rows with ok = 0 are ignored.
/// Threads  pure; any.
#pragma once

#include "app/tracking/situation.h"

#include <span>
#include <vector>

namespace frustumscreen {

[[nodiscard]] std::vector<Situation> pose_frames(std::span<const PoseSample> samples,
                                                 const glm::dvec3& default_eye_m);

} // namespace frustumscreen
