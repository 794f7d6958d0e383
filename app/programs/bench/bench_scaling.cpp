#include "app/bench/measures/report.h"
#include "app/bench/measures/scaling.h"
#include "app/bench/measures/scaling_bakes.h"
#include "app/bench/measures/verdicts.h"
#include "app/programs/bench/bench_command.h"
#include "app/programs/common/command_line.h"

#include <fmt/format.h>

#include <cstdio>
#include <memory>

namespace frustumscreen::programs {

namespace {

struct Arguments {
    BenchPlace place;
    bench::ScalingOptions options;
    bool no_peers = false;
    bool bakes = false;
    bool longer = false;
    std::filesystem::path mesh; ///< baked instead of the amphoras; empty: none
};

/// The folder of frustumscreen-bake and frustumscreen-artifact.
std::filesystem::path programs_folder() {
    std::error_code failed;
    return std::filesystem::read_symlink("/proc/self/exe", failed).parent_path();
}

Result<void> measure_bake_of_file(const Arguments& arguments) {
    std::error_code failed;
    std::filesystem::create_directories(arguments.place.out, failed);
    TRY(const bench::ScalingBake bake,
        bench::bake_of_file(arguments.mesh, arguments.options.size, programs_folder(), arguments.place.out));
    fmt::print("{}", bench::bakes_table({&bake, 1}));
    return write_all(arguments.place.out, {{"bakes.csv", bench::bakes_csv({&bake, 1})}});
}

/// Bakes alone, each in a program of its own.
Result<void> measure_bakes(const Arguments& arguments, BenchProgress& progress) {
    std::vector<std::int64_t> counts = arguments.options.triangles;
    counts.push_back(20'000'000);
    if (arguments.longer) {
        counts.push_back(50'000'000);
    }
    std::error_code failed;
    std::filesystem::create_directories(arguments.place.out, failed);
    std::vector<bench::ScalingBake> bakes;
    for (const std::int64_t count : counts) {
        progress.show(fmt::format("bake of {} triangles", count), 0.0);
        TRY(const bench::ScalingBake bake,
            bench::bake_of_amphora(count, arguments.options.size, programs_folder(), arguments.place.out));
        bakes.push_back(bake);
    }
    progress.clear();
    fmt::print("{}", bench::bakes_table(bakes));
    return write_all(arguments.place.out, {{"scaling_bakes.csv", bench::bakes_csv(bakes)}});
}

/// Makes the files of one set-up: cost against size, and for each amphora that is large enough the comparison
/// with the two-pass method at each of its eye images.
Result<void> measure(const bench::SetUp& set_up, const std::vector<bench::ScalingSource>& sources,
                     const Arguments& arguments, BenchProgress& progress,
                     std::vector<std::pair<std::string, std::string>>& files) {
    const auto show = [&](const std::string& step, double done) {
        progress.show(set_up.name + ": " + step, done);
    };
    TRY(const std::vector<bench::ScalingRow> rows,
        at(set_up.name, bench::scaling(set_up, sources, arguments.options, show)));
    progress.clear();
    fmt::print("{} set-up\n{}\n", set_up.name, bench::scaling_table(rows));
    std::fflush(stdout);
    files.emplace_back("scaling_" + set_up.name + ".csv", bench::scaling_csv(rows));
    for (const bench::ScalingSource& source : sources) {
        if (arguments.no_peers || source.mesh->triangles.size() < bench::min_two_pass_triangles) {
            continue;
        }
        bench::ErrorTimeOptions compared;
        compared.picture = arguments.options.picture;
        compared.poses = arguments.options.poses;
        compared.seed = arguments.options.seed;
        compared.peers.ray_cast = compared.peers.lod = compared.peers.two_pass_lod = false;
        TRY(const bench::SetUpResult result,
            bench::error_time(set_up, source.pack, source.mesh, compared, show));
        progress.clear();
        const std::string title =
            fmt::format("Built-in amphora, {} triangles", source.mesh->triangles.size());
        fmt::print("{}\n{}\n", title, bench::console_table(result));
        std::fflush(stdout);
        files.emplace_back(fmt::format("two_pass_{}_{}.csv", set_up.name, source.mesh->triangles.size()),
                           bench::summary_csv({&result, 1}));
    }
    return {};
}

Result<void> run(const Arguments& arguments, BenchProgress& progress) {
    if (!arguments.mesh.empty()) {
        return measure_bake_of_file(arguments);
    }
    if (arguments.bakes || arguments.longer) {
        return measure_bakes(arguments, progress);
    }
    TRY(const std::vector<bench::SetUp> set_ups, load_set_ups(arguments.place));
    TRY(const std::vector<bench::ScalingSource> sources,
        bench::bake_amphoras(arguments.options, [&](const std::string& step, double done) {
            progress.show("bake: " + step, done);
        }));
    std::vector<std::pair<std::string, std::string>> files;
    for (const bench::SetUp& set_up : set_ups) {
        TRY_VOID(measure(set_up, sources, arguments, progress, files));
    }
    std::vector<std::string> tables;
    for (const auto& [name, text] : files) {
        tables.push_back(name);
    }
    files.emplace_back("limits.csv", bench::limits_csv());
    TRY_VOID(write_all(arguments.place.out, files));
    return draw_all(arguments.place.out, tables);
}

} // namespace

BenchCommand scaling_command(CommandLine& app) {
    CommandLine command = app.add_subcommand(
        "scaling", "measures cost against the number of source triangles, for the built-in amphora");
    const auto arguments = std::make_shared<Arguments>();
    add_place_options(command, arguments->place);
    add_picture_options(command, arguments->options.picture);
    add_pose_options(command, arguments->options.poses, arguments->options.seed);
    command.add_flag("--no-peers", arguments->no_peers, "leave out the two-pass method");
    command.add_flag("--same-surface", arguments->options.same_surface,
                     "use the first amphora only, and subdivide its triangles into four until each number is "
                     "reached: more triangles, the same detail");
    command.add_flag("--bakes", arguments->bakes,
                     "measure only bakes, each in its own process: time, memory and bytes of the pack at "
                     "each count, and at 20 million triangles");
    command.add_flag("--long", arguments->longer, "as --bakes, also at 50 million triangles");
    command.add_option("--mesh", arguments->mesh, "with --bakes: bake this scan, and no amphora")
        .needs("--bakes");
    command
        .add_option("--size", arguments->options.size,
                    "texels along the longest edge of a face, for the bakes")
        .within(16, 4096)
        .capture_default_str();
    command
        .add_option("--triangles", arguments->options.triangles,
                    "numbers of source triangles, one amphora for each")
        .within(1000, 20'000'000)
        .capture_default_str();
    return {command, [arguments](BenchProgress& progress) { return run(*arguments, progress); }};
}

} // namespace frustumscreen::programs
