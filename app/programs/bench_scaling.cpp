#include "app/programs/bench_scaling.h"

#include "app/bench/report.h"
#include "app/bench/scaling.h"
#include "assets_baked/artifacts/builtin.h"
#include "assets_baked/bake/bake.h"

#include <fmt/format.h>

#include <cstdio>
#include <memory>

namespace frustumscreen {

namespace {

struct Arguments {
    BenchPlace place;
    ScalingOptions options;
    bool no_peers = false;
};

/// The amphora of a million triangles against the two-pass method at each of its eye images.
Result<SetUpResult> against_two_pass(const SetUp& set_up, const Arguments& arguments,
                                     BenchProgress& progress) {
    const auto show = [&](const std::string& step, double done) { progress.show(step, done); };
    Result<SourceMesh> made = make_builtin("amphora", 1'000'000);
    if (!made) {
        return tl::unexpected<Error>(made.error());
    }
    const auto mesh = std::make_shared<const SourceMesh>(std::move(*made));
    BakeOptions options;
    options.size = arguments.options.size;
    options.unlit = true;
    options.progress = [&](std::string_view step, double done) { show("bake: " + std::string(step), done); };
    const Result<Pack> pack = bake(*mesh, options);
    if (!pack) {
        return tl::unexpected<Error>(pack.error());
    }
    ErrorTimeOptions compared;
    compared.picture = arguments.options.picture;
    compared.poses = arguments.options.poses;
    compared.seed = arguments.options.seed;
    return error_time(set_up, *pack, mesh, compared, show);
}

Result<void> run(const Arguments& arguments, BenchProgress& progress) {
    const Result<std::vector<SetUp>> set_ups = load_set_ups(arguments.place);
    if (!set_ups) {
        return tl::unexpected<Error>(set_ups.error());
    }
    std::vector<std::pair<std::string, std::string>> files;
    for (const SetUp& set_up : *set_ups) {
        const Result<std::vector<ScalingRow>> rows =
            scaling(set_up, arguments.options, [&](const std::string& step, double done) {
                progress.show(set_up.name + ": " + step, done);
            });
        if (!rows) {
            return at(set_up.name, rows.error());
        }
        progress.clear();
        fmt::print("{} set-up\n{}\n", set_up.name, scaling_table(*rows));
        std::fflush(stdout);
        files.emplace_back("scaling_" + set_up.name + ".csv", scaling_csv(*rows));
        files.emplace_back("scaling_" + set_up.name + ".svg", scaling_svg(*rows));
        if (arguments.no_peers) {
            continue;
        }
        const Result<SetUpResult> compared = against_two_pass(set_up, arguments, progress);
        if (!compared) {
            return tl::unexpected<Error>(compared.error());
        }
        progress.clear();
        fmt::print("built-in amphora, 1M triangles\n{}\n", console_table(*compared));
        files.emplace_back("two_pass_" + set_up.name + ".csv", summary_csv({&*compared, 1}));
        files.emplace_back("two_pass_" + set_up.name + ".svg",
                           error_time_svg(*compared, "Amphora, 1M triangles"));
    }
    return write_all(arguments.place.out, files);
}

} // namespace

BenchCommand scaling_command(CLI::App& app) {
    CLI::App* command = app.add_subcommand("scaling", "cost against the source's size, built-in amphora");
    const auto arguments = std::make_shared<Arguments>();
    add_place_options(*command, arguments->place);
    add_picture_options(*command, arguments->options.picture);
    add_pose_options(*command, arguments->options.poses, arguments->options.seed);
    command->add_flag("--no-peers", arguments->no_peers, "leave out the two-pass method");
    command
        ->add_option("--size", arguments->options.size,
                     "of the bakes, texels along the longest edge of a face")
        ->check(CLI::Range(16, 4096))
        ->capture_default_str();
    command->add_option("--triangles", arguments->options.triangles, "counts of source triangles")
        ->check(CLI::Range(1000, 20'000'000))
        ->capture_default_str();
    return {command, [arguments](BenchProgress& progress) { return run(*arguments, progress); }};
}

} // namespace frustumscreen
