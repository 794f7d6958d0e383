#include "app/programs/frustumscreen/pose_input.h"

#include "firmware_host/base/file.h"
#include "firmware_host/tracker/pose_file.h"

namespace frustumscreen {

Result<std::vector<Situation>> load_pose_frames(const std::filesystem::path& file,
                                                const glm::dvec3& default_eye_m) {
    const Result<Bytes> bytes = read_file(file);
    if (!bytes) {
        return tl::unexpected<Error>(bytes.error());
    }
    const Result<std::vector<PoseSample>> samples = parse_poses(as_text(*bytes), file.string());
    if (!samples) {
        return tl::unexpected<Error>(samples.error());
    }
    return pose_frames(*samples, default_eye_m);
}

} // namespace frustumscreen
