// Pose files: accepted values are finite and in range, written again they read equal, and they can be
// replayed and drawn, with a torch where there is one.
#include "app/tracking/pose_frames.h"
#include "firmware_host/tracker/pose_file.h"
#include "firmware_host/tracker/replay_tracker.h"
#include "tests/fuzz/fuzz.h"

using namespace frustumscreen;

namespace {

void require_sound(const tracker::PoseSample& sample) {
    fuzz::require(sample.station >= tracker::prop_station && sample.station <= tracker::torch_station,
                  "a station is known");
    fuzz::require(fuzz::is_finite(sample.position_m) && glm::length(sample.position_m) < 2000.0,
                  "a position is finite and near");
    fuzz::require(fuzz::is_unit(sample.rotation), "a rotation has length 1");
}

void require_same(const tracker::PoseSample& a, const tracker::PoseSample& b) {
    fuzz::require(a.time == b.time && a.station == b.station && a.ok == b.ok && a.position_m == b.position_m,
                  "a row written again reads the same");
    // Reading normalises a quaternion again: the last digit may differ.
    const glm::dquat d = a.rotation - b.rotation;
    fuzz::require(std::abs(d.w) + std::abs(d.x) + std::abs(d.y) + std::abs(d.z) < 1e-15,
                  "a rotation written again reads the same");
}

/// Several rounds; `speed`: the slowest or the fastest that settings allow.
void check_replay(const std::vector<tracker::PoseSample>& poses, double speed) {
    MonotonicTime now = from_microseconds(1'000'000);
    MonotonicTime latest = now;
    tracker::ReplayTracker tracker(poses, now, true, speed);
    for (int k = 0; k < 24; ++k, now += std::chrono::milliseconds(1 << k % 12)) {
        std::vector<tracker::PoseSample> samples;
        fuzz::require(tracker.poll(now, samples).has_value(), "a replay has no errors");
        for (const tracker::PoseSample& sample : samples) {
            fuzz::require(sample.time >= latest && sample.time <= now, "a replay's times ascend up to now");
            latest = sample.time;
        }
    }
}

/// The frames that `frustumscreen render` draws.
void check_frames(const std::vector<tracker::PoseSample>& poses) {
    for (const tracking::TrackedState& frame : tracking::pose_frames(poses, {0.0, -0.5, 0.5})) {
        for (const tracking::TrackedTorch& torch : frame.torches) {
            fuzz::require(torch.share == 0.0 || torch.share == 1.0, "a torch is there or not");
            fuzz::require(fuzz::is_unit(torch.table_from_torch.rotation) &&
                              fuzz::is_finite(torch.table_from_torch.translation),
                          "a torch has a pose");
        }
    }
}

} // namespace

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string_view text = fuzz::text_of(data, size);
    const auto poses = tracker::parse_poses(text, "poses.csv");
    const auto ascending = tracker::parse_poses(text, "poses.csv", tracker::PoseOrder::PropAscends);
    if (!ascending) {
        fuzz::require_one_line(ascending.error().message);
    }
    if (!poses) {
        fuzz::require_one_line(poses.error().message);
        fuzz::require(!ascending, "the stricter order takes no more");
        return 0;
    }
    const auto again =
        tracker::parse_poses(tracker::write_poses(*poses), "again.csv",
                             ascending ? tracker::PoseOrder::PropAscends : tracker::PoseOrder::AsWritten);
    fuzz::require(again && again->size() == poses->size(), "what was written is read",
                  again ? std::string() : again.error().message);
    for (std::size_t k = 0; k < poses->size(); ++k) {
        require_sound((*poses)[k]);
        require_same((*poses)[k], (*again)[k]);
    }
    check_replay(*poses, 0.01);
    check_replay(*poses, 100.0);
    check_frames(*poses);
    return 0;
}
