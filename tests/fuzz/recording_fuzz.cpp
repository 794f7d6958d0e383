// Recordings of other trackers: accepted poses ascend in time, are finite, and can be written as a pose file.
#include "firmware_host/tracker/convert_recording.h"
#include "firmware_host/tracker/pose_file.h"
#include "tests/fuzz/fuzz.h"

using namespace frustumscreen;

namespace {

void require_sound(const tracker::ConvertedRecording& recording, const tracker::RecordingOptions& options) {
    const glm::dvec2 most = options.half_extent_m + glm::dvec2(1e-9);
    std::optional<MonotonicTime> before;
    for (const tracker::PoseSample& sample : recording.samples) {
        fuzz::require(sample.ok && sample.station == options.station, "a sample is good and of its station");
        fuzz::require(!before || *before < sample.time, "times ascend");
        before = sample.time;
        const glm::dvec3& p = sample.position_m;
        fuzz::require(fuzz::is_finite(p) && fuzz::is_unit(sample.rotation), "a pose is finite");
        fuzz::require(!options.flat || (std::abs(p.x) <= most.x && std::abs(p.y) <= most.y && p.z == 0.0),
                      "a flat motion stays where it may be");
    }
}

} // namespace

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string_view text = fuzz::text_of(data, size);
    for (const bool flat : {false, true}) {
        tracker::RecordingOptions options;
        options.flat = flat;
        const auto recording = tracker::convert_recording(text, "recording.txt", options);
        if (!recording) {
            fuzz::require_one_line(recording.error().message);
            continue;
        }
        require_sound(*recording, options);
        const auto poses = tracker::parse_poses(tracker::write_poses(recording->samples), "poses.csv",
                                                tracker::PoseOrder::PropAscends);
        fuzz::require(poses && poses->size() == recording->samples.size(), "a recording is a pose file",
                      poses ? std::string() : poses.error().message);
    }
    return 0;
}
