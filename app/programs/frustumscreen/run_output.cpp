#include "app/programs/frustumscreen/run_output.h"

#include "app/show/run_report.h"
#include "app/simulation/visitor_view.h"
#include "firmware_host/base/file.h"
#include "firmware_host/sound/wav_sound.h"
#include "firmware_host/tracker/pose_file.h"

#include <fmt/format.h>

#include <vector>

namespace frustumscreen::programs {

namespace {

Result<void> write_pictures(const std::filesystem::path& folder, const show::LoopResult& result) {
    std::vector<tracker::PoseSample> poses;
    for (std::size_t k = 0; k < result.stills.size(); ++k) {
        const show::Still& still = result.stills[k];
        const geometry::RigidTransform& pose = still.tracked_state.table_from_prop;
        poses.push_back({.time = still.time,
                         .station = tracker::prop_station,
                         .position_m = pose.translation,
                         .rotation = pose.rotation,
                         .ok = true});
        poses.push_back({.time = still.time,
                         .station = tracker::head_station,
                         .position_m = still.tracked_state.eye_m,
                         .rotation = still.tracked_state.table_from_head,
                         .ok = true});
        if (const tracking::TrackedTorch& torch = still.tracked_state.torches[0]; torch.share > 0.0) {
            poses.push_back({.time = still.time,
                             .station = tracker::torch_station,
                             .position_m = torch.table_from_torch.translation,
                             .rotation = torch.table_from_torch.rotation,
                             .ok = true});
        }
        const std::filesystem::path file = folder / fmt::format("frame_{:05}.png", k);
        TRY_VOID(write_file(file, image::encode_png(still.picture)));
    }
    for (std::size_t k = 0; k < result.screen_stills.size(); ++k) {
        TRY_VOID(write_file(folder / fmt::format("screen_{:05}.png", k),
                            image::encode_png(result.screen_stills[k].picture)));
    }
    TRY_VOID(write_file(folder / "poses.csv", as_bytes(tracker::write_poses(poses))));
    return write_file(folder / "frames.csv", as_bytes(show::frames_csv(result.rows)));
}

} // namespace

Result<void> write_output(const std::filesystem::path& folder, const show::LoopResult& result,
                          const sound::Sound* sound) {
    std::error_code failed;
    std::filesystem::remove(folder / simulation::visitor_cameras_name, failed);
    TRY_VOID(write_pictures(folder, result));
    const auto* const heard = dynamic_cast<const sound::WavSound*>(sound);
    return heard != nullptr ? heard->write(folder / "sound.wav") : Result<void>();
}

void report(const RunRequest& request, const show::LoopResult& result) {
    show::RunStatus status = result.status;
    show::stamp(status);
    if (request.json) {
        fmt::print("{}", status::status_json(status));
        return;
    }
    const auto [median_ms, p95_ms, p99_ms] = status.frame_ms;
    fmt::print(
        "{} frames in {:.1f} s, {} drawn: median {:.2f} ms, 95th percentile {:.2f} ms, 99th {:.2f} ms; {} "
        "deadlines and {} display times missed, {} changes of level; {:.0f} MiB resident",
        status.frames, *status.uptime_s, status.drawn, *median_ms, *p95_ms, *p99_ms, status.missed_deadlines,
        status.skipped, status.level_switches, *status.resident_mib);
    if (request.changes > 0) {
        fmt::print("; {} changes of artifact, {:+.1f} MiB since the first tenth, p99/p50 {:.2f}",
                   request.changes, *status.resident_mib - result.first_resident_mib,
                   *median_ms > 0.0 ? *p99_ms / *median_ms : 0.0);
    }
    fmt::print("\n");
    if (!request.out.empty()) {
        fmt::print("{} pictures in {}\n", result.stills.size(), request.out.string());
    }
}

} // namespace frustumscreen::programs
