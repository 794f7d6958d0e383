#include "app/bench/latency/recorded_poses.h"
#include "app/programs/bench/bench_command.h"
#include "app/programs/common/command_line.h"
#include "firmware_host/base/file.h"
#include "firmware_host/base/standard_error.h"
#include "tests/simulators/tags/tag_figures.h"

#include <memory>

namespace frustumscreen::programs {

namespace {

struct Arguments {
    std::filesystem::path out;
    std::filesystem::path recordings = "../shared/data/tracker";
    std::size_t pictures = 40;
    std::uint64_t seed = 1;
    bool half = false;
};

/// The hand's motion in a recording, from a random moment on. The recording's up axis is the table's.
std::function<simulators::PropMotion(std::mt19937_64&)>
slid_as(std::shared_ptr<const std::vector<bench::RecordedPose>> poses) {
    return [poses = std::move(poses)](std::mt19937_64& random) -> simulators::PropMotion {
        std::uniform_real_distribution<double> any_s(poses->front().t_s, poses->back().t_s);
        return [poses, motion = bench::slid(bench::recorded(*poses), any_s(random))](double t_s) {
            return motion(t_s);
        };
    };
}

/// Skips missing recordings, with a line.
Result<void> add_recordings(const std::filesystem::path& folder, std::vector<simulators::TagCase>& cases) {
    for (const char* name : {"vicon_handheld_1.csv", "tum_fr1_xyz_groundtruth.txt"}) {
        if (!std::filesystem::exists(folder / name)) {
            say_line("frustumscreen-bench",
                     fmt::format("{}: this recording is missing and is skipped", (folder / name).string()));
            continue;
        }
        TRY(std::vector<bench::RecordedPose> poses, bench::read_recorded_poses(folder / name));
        const auto motion =
            slid_as(std::make_shared<const std::vector<bench::RecordedPose>>(std::move(poses)));
        for (const double rolling_ms : {0.0, 25.0}) {
            simulators::TagCase one;
            one.name =
                fmt::format("slid as in {}, {} shutter", name, rolling_ms > 0.0 ? "rolling 25 ms" : "global");
            one.motion = motion;
            one.camera.rolling_ms = rolling_ms;
            cases.push_back(one);
            if (rolling_ms > 0.0) {
                cases.push_back(simulators::with_known_shutter(one));
            }
        }
    }
    return {};
}

Result<void> run(const Arguments& arguments, BenchProgress& progress) {
    std::vector<simulators::TagCase> cases = simulators::tag_cases();
    TRY_VOID(add_recordings(arguments.recordings, cases));
    for (simulators::TagCase& one : cases) {
        one.decimate = arguments.half ? 2.0 : 1.0;
    }
    std::vector<simulators::TagFigures> figures;
    for (const simulators::TagCase& one : cases) {
        progress.show(one.name, static_cast<double>(figures.size()) / static_cast<double>(cases.size()));
        figures.push_back(simulators::measure(one, arguments.pictures, arguments.seed));
    }
    progress.clear();
    fmt::print("{}", simulators::table_of(figures));
    return write_all(arguments.out, {{"tags.csv", simulators::csv_of(figures)}});
}

} // namespace

BenchCommand tags_command(CommandLine& app) {
    CommandLine command = app.add_subcommand(
        "tags", "measures the prop's pose from its tags, in rendered scenes: error, spread and time");
    const auto arguments = std::make_shared<Arguments>();
    command.add_option("--out", arguments->out, "folder for the table").required();
    command
        .add_option("--recordings", arguments->recordings,
                    "folder of recorded hand motions that slide the prop too")
        .capture_default_str();
    command.add_option("--pictures", arguments->pictures, "pictures of each scene")
        .within(1, 100000)
        .capture_default_str();
    command.add_flag("--half", arguments->half,
                     "search at half size, as the exhibit does when a frame takes long");
    command.add_option("--seed", arguments->seed, "seed of poses and noise").capture_default_str();
    return {command, [arguments](BenchProgress& progress) { return run(*arguments, progress); }};
}

} // namespace frustumscreen::programs
