#include "app/bench/latency/recorded_poses.h"

#include "firmware_host/base/file.h"
#include "firmware_host/tracker/convert_recording.h"

namespace frustumscreen::bench {

Result<std::vector<RecordedPose>> read_recorded_poses(const std::filesystem::path& file) {
    TRY(const Bytes bytes, read_file(file));
    TRY(const tracker::ConvertedRecording converted,
        tracker::convert_recording(as_text(bytes), file.string(), {}));
    std::vector<RecordedPose> poses;
    for (const tracker::PoseSample& sample : converted.samples) {
        poses.push_back({to_seconds(sample.time.time_since_epoch()), {sample.rotation, sample.position_m}});
    }
    return poses;
}

} // namespace frustumscreen::bench
