/// The frames of a pose file that is named on the command line.
///
/// Errors   the file is missing or is not a pose file.
/// Threads  any.
#pragma once

#include "app/tracking/pose_frames.h"
#include "firmware_host/base/result.h"

#include <filesystem>
#include <vector>

namespace frustumscreen::programs {

[[nodiscard]] Result<std::vector<tracking::TrackedState>> load_pose_frames(const std::filesystem::path& file,
                                                                           const glm::dvec3& default_eye_m);

} // namespace frustumscreen::programs
