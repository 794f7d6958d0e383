/// A minimum-jerk path through poses, as a hand moves to a known target: smooth from one pose to the next.
///
/// Between two poses of a station the position follows 10 s^3 - 15 s^4 + 6 s^5, where s is the fraction of
/// the time; the rotation turns the shorter way by the same fraction of its angle. Between two equal poses
/// the path rests.
///
/// Frame    as the poses.
/// Threads  pure; any.
/// Errors   a station's poses are not in the order of their times; a path of more than a million periods.
/// Source   Flash, Hogan 1985, 'The coordination of arm movements': the minimum-jerk path.
#pragma once

#include "firmware_host/base/result.h"
#include "firmware_host/tracker/tracker.h"

#include <span>
#include <vector>

namespace frustumscreen::tracker {

/// `keys` are in the order of their times for each station. A key that is not ok ends its station's path; the
/// next one begins a new path. Returns poses of all stations at every period from the first key's time to the
/// last key's, in the order of their times.
[[nodiscard]] Result<std::vector<PoseSample>> pose_path(std::span<const PoseSample> keys, Nanoseconds period);

} // namespace frustumscreen::tracker
