#include "app/bench/measures/projection.h"
#include "app/programs/bench/bench_command.h"
#include "app/programs/common/command_line.h"

#include <memory>

namespace frustumscreen::programs {

namespace {

struct Arguments {
    BenchPlace place;
    BenchArtifact artifact;
    bench::ProjectionOptions options;
};

Result<void> run(const Arguments& arguments, BenchProgress& progress) {
    return measure_set_ups(
        "projection", arguments.place, arguments.artifact, progress,
        [&](const bench::SetUp& set_up, const pack::Pack& pack,
            const std::shared_ptr<const bake::SourceMesh>& mesh, const bench::StepProgress& steps) {
            return bench::projection(set_up, pack, mesh, arguments.options, steps);
        },
        bench::projection_table,
        [](const std::vector<bench::ProjectionResult>& results) {
            return OutputFiles{{"projection.csv", bench::projection_csv(results)}};
        });
}

} // namespace

BenchCommand projection_command(CommandLine& app) {
    CommandLine command = app.add_subcommand(
        "projection",
        "measures the error of the visitor's view at the default and finest level, against a ray cast");
    const auto arguments = std::make_shared<Arguments>();
    add_place_options(command, arguments->place);
    add_artifact_options(command, arguments->artifact);
    add_picture_options(command, arguments->options.picture);
    add_pose_options(command, arguments->options.poses, arguments->options.seed);
    return {command, [arguments](BenchProgress& progress) { return run(*arguments, progress); }};
}

} // namespace frustumscreen::programs
