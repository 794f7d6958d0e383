#include "app/bench/measures/shimmer.h"
#include "app/programs/bench/bench_command.h"
#include "app/programs/common/command_line.h"

#include <memory>

namespace frustumscreen::programs {

namespace {

struct Arguments {
    BenchPlace place;
    BenchArtifact artifact;
    bench::ShimmerOptions options;
    bool one_ray = false;
};

Result<void> run(const Arguments& arguments, BenchProgress& progress) {
    return measure_set_ups(
        "shimmer", arguments.place, arguments.artifact, progress,
        [&](const bench::SetUp& set_up, const pack::Pack& pack,
            const std::shared_ptr<const bake::SourceMesh>& mesh, const bench::StepProgress& steps) {
            return bench::shimmer(set_up, pack, mesh, arguments.options, steps);
        },
        bench::shimmer_table,
        [](const std::vector<bench::ShimmerResult>& results) {
            return OutputFiles{{"shimmer.csv", bench::shimmer_csv(results)},
                               {"edge_sparkle.csv", bench::edge_sparkle_csv(results)}};
        });
}

} // namespace

BenchCommand shimmer_command(CommandLine& app) {
    CommandLine command =
        app.add_subcommand("shimmer", "measures flicker while the prop moves in small steps: default and "
                                      "finest level against a ray cast, edges between faces");
    const auto arguments = std::make_shared<Arguments>();
    add_place_options(command, arguments->place);
    add_artifact_options(command, arguments->artifact);
    add_picture_options(command, arguments->options.picture);
    add_pose_options(command, arguments->options.poses, arguments->options.seed);
    command
        .add_option("--steps", arguments->options.steps,
                    "steps in each direction, of 0.1 projector pixel, and of 0.1 mm for the edges")
        .within(2, 1000)
        .capture_default_str();
    command.add_flag("--one-ray", arguments->one_ray, "leave out the ray cast with 16 rays a pixel");
    return {command, [arguments](BenchProgress& progress) {
                arguments->options.sixteen_rays = !arguments->one_ray;
                return run(*arguments, progress);
            }};
}

} // namespace frustumscreen::programs
