#include "app/bench/latency/hand_replay.h"
#include "app/bench/latency/latency_report.h"
#include "app/bench/latency/recorded_poses.h"
#include "app/programs/bench/bench_command.h"
#include "app/programs/common/command_line.h"
#include "firmware_host/base/file.h"

#include <array>
#include <memory>
#include <string_view>

namespace frustumscreen::programs {

namespace {

struct Arguments {
    std::filesystem::path out;
    std::filesystem::path recordings = "../shared/data/tracker";
    bench::LatencyOptions options;
};

/// The targets are set for the first tracker. Only its latency of 18 ms is known; those of the others are
/// assumed.
std::vector<bench::TrackedBy> trackers() {
    return {{"Polhemus PATRIOT", 60.0, 18.0, {}},
            {"Polhemus VIPER", 240.0, 5.0, {}},
            {"HID tracker", 120.0, 12.0, {}}};
}

struct RecordingFile {
    std::string_view name;
    bool noisy; ///< has its own noise; the others are motion capture
};
constexpr std::array recording_files = {
    RecordingFile{"vicon_handheld_1.csv", false}, RecordingFile{"tum_fr1_xyz_groundtruth.txt", false},
    RecordingFile{"camera_target_handheld_1.csv", true}, RecordingFile{"tum_fr1_xyz_rgbdslam.txt", true}};

Result<void> run(const Arguments& arguments, BenchProgress& progress) {
    const std::vector<bench::TrackedBy> measured_trackers = trackers();
    std::vector<bench::TrackerResult> results;
    for (const bench::TrackedBy& tracker : measured_trackers) {
        progress.show(tracker.name,
                      static_cast<double>(results.size()) / static_cast<double>(measured_trackers.size()));
        results.push_back(bench::measure_tracker(tracker, arguments.options));
        progress.clear();
        fmt::print("{}\n", bench::latency_table(results.back(), arguments.options));
    }
    std::vector<bench::RecordingResult> recordings;
    std::vector<bench::ReplayResult> replayed;
    for (const RecordingFile& file : recording_files) {
        const std::filesystem::path path = arguments.recordings / file.name;
        if (!std::filesystem::exists(path)) {
            fmt::print(stderr, "frustumscreen-bench: {}: this recording is missing and is skipped\n",
                       path.string());
            continue;
        }
        TRY(std::vector<bench::RecordedPose> poses, bench::read_recorded_poses(path));
        const bench::PoseRecording recording{std::string(file.name), std::move(poses), file.noisy};
        recordings.push_back(bench::measure_recording(recording, arguments.options));
        if (!file.noisy) { // the truth of a noisy one is not known
            for (const bench::TrackedBy& tracker : measured_trackers) {
                progress.show(fmt::format("{}, {}", tracker.name, file.name), 1.0);
                std::vector<bench::ReplayResult> more = bench::replay(recording, tracker, arguments.options);
                replayed.insert(replayed.end(), more.begin(), more.end());
                progress.clear();
            }
        }
    }
    if (!recordings.empty()) {
        fmt::print("{}\n{}\n", bench::recordings_table(recordings), bench::replay_table(replayed));
    }
    fmt::print("{}", bench::lines_of(bench::judge(results.front(), arguments.options)));
    Result<void> written = write_all(arguments.out, {{"latency.csv", bench::latency_csv(results, recordings)},
                                                     {"latency_hand.csv", bench::replay_csv(replayed)}});
    return written ? draw_all(arguments.out, {"latency.csv"}) : written;
}

} // namespace

BenchCommand latency_command(CommandLine& app) {
    CommandLine command = app.add_subcommand(
        "latency",
        "measures the displacement of the picture on a moving prop, by filter, prediction and latency");
    const auto arguments = std::make_shared<Arguments>();
    command.add_option("--out", arguments->out, "folder for the tables and plots").required();
    command.add_option("--recordings", arguments->recordings, "folder of recordings that are replayed too")
        .capture_default_str();
    command
        .add_option("--display-latency-ms", arguments->options.setting.display_latency_ms,
                    "time from the poll of the tracker until the picture is lit")
        .within(0.0, 200.0)
        .capture_default_str();
    command.add_option("--seconds", arguments->options.length_s, "length of each motion")
        .within(5.0, 3600.0)
        .capture_default_str();
    command.add_option("--seed", arguments->options.seed, "seed of motion and noise").capture_default_str();
    return {command, [arguments](BenchProgress& progress) { return run(*arguments, progress); }};
}

} // namespace frustumscreen::programs
