#include "app/programs/frustumscreen/render/pose_input.h"

#include "firmware_host/base/file.h"
#include "firmware_host/tracker/pose_file.h"

namespace frustumscreen::programs {

Result<std::vector<tracking::TrackedState>> load_pose_frames(const std::filesystem::path& file,
                                                             const glm::dvec3& default_eye_m) {
    TRY(const Bytes bytes, read_file(file));
    TRY(const std::vector<tracker::PoseSample> samples, tracker::parse_poses(as_text(bytes), file.string()));
    return tracking::pose_frames(samples, default_eye_m);
}

} // namespace frustumscreen::programs
