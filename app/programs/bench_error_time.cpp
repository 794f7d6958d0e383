#include "app/programs/bench_error_time.h"

#include "app/bench/error_time.h"
#include "app/bench/figures.h"
#include "app/bench/report.h"

#include <fmt/format.h>

#include <cstdio>
#include <memory>

namespace frustumscreen {

namespace {

struct Arguments {
    BenchPlace place;
    BenchArtifact artifact;
    ErrorTimeOptions options;
    bool no_peers = false;
};

/// The pack's own figures, measured again; in mm on the first set-up's prop.
void print_figures(const LoadedArtifact& artifact, const SetUp& set_up, BenchProgress& progress) {
    progress.show("the pack's own figures", 0.0);
    const std::vector<LevelFigures> figures = measure_figures(*artifact.pack, *artifact.mesh);
    progress.clear();
    const double mm_per_box = 1e3 * place(*artifact.pack, make_prop(set_up.settings.prop)).metres_per_box;
    fmt::print("Are the pack's own figures true?\n{}\n", lines_of(judge(figures, mm_per_box)));
}

Result<void> run(const Arguments& arguments, BenchProgress& progress) {
    const Result<std::vector<SetUp>> set_ups = load_set_ups(arguments.place);
    if (!set_ups) {
        return tl::unexpected<Error>(set_ups.error());
    }
    const Result<LoadedArtifact> artifact = load_artifact(arguments.artifact);
    if (!artifact) {
        return tl::unexpected<Error>(artifact.error());
    }
    const Pack& pack = *artifact->pack;
    print_figures(*artifact, set_ups->front(), progress);
    std::vector<SetUpResult> results;
    std::vector<std::pair<std::string, std::string>> files;
    for (const SetUp& set_up : *set_ups) {
        Result<SetUpResult> result =
            error_time(set_up, pack, artifact->mesh, arguments.options,
                       [&](const std::string& step, double done) { progress.show(step, done); });
        if (!result) {
            return tl::unexpected<Error>(result.error());
        }
        progress.clear();
        fmt::print("{}\n", console_table(*result));
        std::fflush(stdout);
        files.emplace_back("error_time_" + set_up.name + ".svg", error_time_svg(*result, pack.title));
        for (const auto& [level, picture] : result->worst) {
            files.emplace_back(fmt::format("worst_{}_{}.png", set_up.name, level),
                               as_text(encode_png(picture)));
        }
        results.push_back(std::move(*result));
    }
    files.emplace_back("error_time.csv", summary_csv(results));
    files.emplace_back("error_time_poses.csv", poses_csv(results));
    files.emplace_back("error_time.json", report_json(results, pack.title));
    return write_all(arguments.place.out, files);
}

} // namespace

BenchCommand error_time_command(CLI::App& app) {
    CLI::App* command =
        app.add_subcommand("error-time", "every level of a pack and its peers against a ray cast");
    const auto arguments = std::make_shared<Arguments>();
    add_place_options(*command, arguments->place);
    add_artifact_options(*command, arguments->artifact);
    add_picture_options(*command, arguments->options.picture);
    add_pose_options(*command, arguments->options.poses, arguments->options.seed);
    command->add_flag("--no-peers", arguments->no_peers, "leave out the full mesh and the two-pass method");
    command->add_flag("--relief-peers", arguments->options.relief_peers,
                      "marching and warping of relief images too");
    command->add_option("--relief-texels", arguments->options.relief_texels, "a side of their images")
        ->check(CLI::IsMember({128, 256, 512, 1024}))
        ->capture_default_str();
    return {command, [arguments](BenchProgress& progress) {
                arguments->options.peers = !arguments->no_peers;
                return run(*arguments, progress);
            }};
}

} // namespace frustumscreen
