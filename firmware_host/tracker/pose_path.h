/// A path through poses, as a hand moves that knows where it goes: from one to the next without a jerk.
///
/// Between two poses of a station the place follows 10 s^3 - 15 s^4 + 6 s^5 of the time's share s, the rotation turns the
/// shorter way by the same share of its angle. Two equal poses rest.
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

namespace frustumscreen {

/// `keys`: of each station in the order of their times; those that are not ok end a path, and the next begins another.
/// Returns poses of all stations at every period from the first key's time to the last key's, in the order of their times.
[[nodiscard]] Result<std::vector<PoseSample>> pose_path(std::span<const PoseSample> keys, Nanoseconds period);

} // namespace frustumscreen
