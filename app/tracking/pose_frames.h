/// The frames of an offline picture run, from a pose file: one for every time at which the prop has a pose.
///
/// Frames   table T, metres; neither filtered nor predicted. Times are ascending and unique; of several
///          usable rows with equal time and station the first counts. The eye is the head's row of that time,
///          otherwise the default eye. Rows with ok = 0 are ignored.
/// Eyes     two for stereo, beside that point: the head is turned as its row says; at the default eye it looks level
///          at the prop.
/// Threads  pure; any.
#pragma once

#include "app/tracking/tracked_state.h"

#include <span>
#include <vector>

namespace frustumscreen::tracking {

[[nodiscard]] std::vector<TrackedState> pose_frames(std::span<const tracker::PoseSample> samples,
                                                    const glm::dvec3& default_eye_m);

} // namespace frustumscreen::tracking
