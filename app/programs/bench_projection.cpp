#include "app/programs/bench_projection.h"

#include "app/bench/projection.h"

#include <fmt/format.h>

#include <cstdio>
#include <memory>

namespace frustumscreen {

namespace {

struct Arguments {
    BenchPlace place;
    BenchArtifact artifact;
    ProjectionOptions options;
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
    std::vector<ProjectionResult> results;
    std::vector<std::pair<std::string, std::string>> files;
    for (const SetUp& set_up : *set_ups) {
        Result<ProjectionResult> result =
            projection(set_up, *artifact->pack, artifact->mesh, arguments.options,
                       [&](const std::string& step, double done) { progress.show(step, done); });
        if (!result) {
            return tl::unexpected<Error>(result.error());
        }
        progress.clear();
        fmt::print("{}\n", projection_table(*result));
        std::fflush(stdout);
        files.emplace_back("projection_" + set_up.name + ".png", as_text(encode_png(result->worst)));
        results.push_back(std::move(*result));
    }
    files.emplace_back("projection.csv", projection_csv(results));
    return write_all(arguments.place.out, files);
}

} // namespace

BenchCommand projection_command(CLI::App& app) {
    CLI::App* command =
        app.add_subcommand("projection", "the visitor's view of default and finest level against a ray cast");
    const auto arguments = std::make_shared<Arguments>();
    add_place_options(*command, arguments->place);
    add_artifact_options(*command, arguments->artifact);
    add_picture_options(*command, arguments->options.picture);
    add_pose_options(*command, arguments->options.poses, arguments->options.seed);
    return {command, [arguments](BenchProgress& progress) { return run(*arguments, progress); }};
}

} // namespace frustumscreen
