#include "app/bench/techniques/pack_cells.h"
#include "app/bench/truth/poses.h"
#include "app/programs/bench/bench_command.h"
#include "app/programs/common/command_line.h"

#include <memory>

namespace frustumscreen::programs {

namespace {

struct Arguments {
    BenchPlace place;
    std::filesystem::path pack;
    int poses = 12;
    int rounds = 3;
    std::uint64_t seed = 1;
};

std::string csv_of(const std::vector<bench::TechniqueResult>& results) {
    std::string text = "name,triangles,samples,ms,cpu_ms,times_floor,cpu_times_floor\n";
    for (const bench::TechniqueResult& each : results) {
        text += fmt::format("{},{},{},{:.4f},{:.4f},{:.3f},{:.3f}\n", each.name, each.triangles, each.samples,
                            each.time_ms.median, each.cpu_ms, each.times_floor, each.cpu_times_floor);
    }
    return text;
}

Result<std::string> time_whole_and_cells(const bench::SetUp& set_up, const Arguments& arguments,
                                         BenchProgress& progress) {
    TRY(const pack::VerifiedPack pack, pack::load_pack(arguments.pack));
    TRY(const std::unique_ptr<bench::TechniqueSet> set, bench::TechniqueSet::open(set_up));
    bench::PictureOptions options;
    options.timed_lit = true;
    for (std::uint32_t level = 0; level + 1 < pack->levels.size(); ++level) {
        TRY_VOID(set->add_level(*pack, level, options));
    }
    TRY_VOID(set->add_reliefs(*pack, options));
    TRY(const std::string ways, set->add_cells(arguments.pack, *pack, options));
    TRY(const std::vector<bench::BenchPose> poses,
        bench::draw_poses(set_up.settings, set->kiosk().prop, arguments.poses, arguments.seed));
    set->measure_times(poses, arguments.rounds,
                       [&](double done) { progress.show("frames, " + set_up.name, done); });
    progress.clear();
    const std::string csv = csv_of(set->results());
    fmt::print("{}\n{}{}\n", set_up.name, csv, ways);
    std::fflush(stdout);
    return csv;
}

Result<void> run(const Arguments& arguments, BenchProgress& progress) {
    TRY(const std::vector<bench::SetUp> set_ups, load_set_ups(arguments.place));
    OutputFiles files;
    for (const bench::SetUp& set_up : set_ups) {
        TRY(std::string csv, time_whole_and_cells(set_up, arguments, progress));
        files.emplace_back("cells_" + set_up.name + ".csv", std::move(csv));
    }
    return write_all(arguments.place.out, files);
}

} // namespace

BenchCommand cells_command(CommandLine& app) {
    CommandLine command = app.add_subcommand(
        "cells", "times a pack's levels and reliefs against its cells at rest, in one run");
    const auto arguments = std::make_shared<Arguments>();
    add_place_options(command, arguments->place);
    command.add_option("--pack", arguments->pack, "pack with cells").required();
    add_pose_options(command, arguments->poses, arguments->seed);
    command.add_option("--rounds", arguments->rounds, "number of frames of each pose")
        .within(1, 1000)
        .capture_default_str();
    return {command, [arguments](BenchProgress& progress) { return run(*arguments, progress); }};
}

} // namespace frustumscreen::programs
