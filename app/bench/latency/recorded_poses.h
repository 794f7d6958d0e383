/// The poses of a recording, read by the trackers' converter.
///
/// Threads  any.
/// Errors   an unreadable file, or not a recording: a sentence with its place.
#pragma once

#include "app/bench/latency/hand_motion.h"
#include "firmware_host/base/result.h"

#include <filesystem>
#include <vector>

namespace frustumscreen::bench {

/// In ascending time.
[[nodiscard]] Result<std::vector<RecordedPose>> read_recorded_poses(const std::filesystem::path& file);

} // namespace frustumscreen::bench
