#include "app/bench/measures/projection.h"
#include "app/programs/bench/bench_command.h"
#include "app/programs/common/command_line.h"

#include <memory>

namespace frustumscreen {

namespace {

struct Arguments {
    BenchPlace place;
    BenchArtifact artifact;
    ProjectionOptions options;
};

Result<void> run(const Arguments& arguments, BenchProgress& progress) {
    return measure_set_ups(
        "projection", arguments.place, arguments.artifact, progress,
        [&](const SetUp& set_up, const Pack& pack, const std::shared_ptr<const SourceMesh>& mesh,
            const StepProgress& steps) { return projection(set_up, pack, mesh, arguments.options, steps); },
        projection_table,
        [](const std::vector<ProjectionResult>& results) {
            return OutputFiles{{"projection.csv", projection_csv(results)}};
        });
}

} // namespace

BenchCommand projection_command(CommandLine& app) {
    CommandLine command = app.add_subcommand(
        "projection", "error of the visitor's view at the default and the finest level, against a ray cast");
    const auto arguments = std::make_shared<Arguments>();
    add_place_options(command, arguments->place);
    add_artifact_options(command, arguments->artifact);
    add_picture_options(command, arguments->options.picture);
    add_pose_options(command, arguments->options.poses, arguments->options.seed);
    return {command, [arguments](BenchProgress& progress) { return run(*arguments, progress); }};
}

} // namespace frustumscreen
