#include "app/programs/bench_shimmer.h"

#include "app/bench/shimmer.h"

#include <fmt/format.h>

#include <cstdio>
#include <memory>

namespace frustumscreen {

namespace {

struct Arguments {
    BenchPlace place;
    BenchArtifact artifact;
    ShimmerOptions options;
    bool one_ray = false;
};

Result<void> run(const Arguments& arguments, BenchProgress& progress) {
    const Result<std::vector<SetUp>> set_ups = load_set_ups(arguments.place);
    if (!set_ups) {
        return tl::unexpected<Error>(set_ups.error());
    }
    const Result<LoadedArtifact> artifact = load_artifact(arguments.artifact);
    if (!artifact) {
        return tl::unexpected<Error>(artifact.error());
    }
    std::vector<ShimmerResult> results;
    std::vector<std::pair<std::string, std::string>> files;
    for (const SetUp& set_up : *set_ups) {
        Result<ShimmerResult> result =
            shimmer(set_up, *artifact->pack, artifact->mesh, arguments.options,
                    [&](const std::string& step, double done) { progress.show(step, done); });
        if (!result) {
            return tl::unexpected<Error>(result.error());
        }
        progress.clear();
        fmt::print("{}\n", shimmer_table(*result));
        std::fflush(stdout);
        files.emplace_back("shimmer_" + set_up.name + ".png", as_text(encode_png(result->worst)));
        results.push_back(std::move(*result));
    }
    files.emplace_back("shimmer.csv", shimmer_csv(results));
    return write_all(arguments.place.out, files);
}

} // namespace

BenchCommand shimmer_command(CLI::App& app) {
    CLI::App* command = app.add_subcommand(
        "shimmer", "the prop moved by 0.1 pixel steps: default and finest level against a ray cast");
    const auto arguments = std::make_shared<Arguments>();
    add_place_options(*command, arguments->place);
    add_artifact_options(*command, arguments->artifact);
    add_picture_options(*command, arguments->options.picture);
    add_pose_options(*command, arguments->options.poses, arguments->options.seed);
    command->add_option("--steps", arguments->options.steps, "of 0.1 projector pixel in each direction")
        ->check(CLI::Range(2, 1000))
        ->capture_default_str();
    command->add_flag("--one-ray", arguments->one_ray, "leave out the ray cast with 16 rays a pixel");
    return {command, [arguments](BenchProgress& progress) {
                arguments->options.sixteen_rays = !arguments->one_ray;
                return run(*arguments, progress);
            }};
}

} // namespace frustumscreen
