#include "app/bench/measures/error_time.h"
#include "app/bench/measures/figures.h"
#include "app/bench/measures/report.h"
#include "app/programs/bench/bench_command.h"
#include "app/programs/common/command_line.h"

#include <fmt/format.h>

#include <cstdio>
#include <memory>

namespace frustumscreen::programs {

namespace {

struct Arguments {
    BenchPlace place;
    BenchArtifact artifact;
    bench::ErrorTimeOptions options;
    std::string peers = "all";
    std::string limits = "all";
};

/// Every step of the run, for the remaining time of the whole run.
std::vector<bench::WorkStep> all_steps(const std::vector<bench::SetUp>& set_ups,
                                       const LoadedArtifact& artifact,
                                       const bench::ErrorTimeOptions& options) {
    std::vector<bench::WorkStep> steps = {
        {"the pack's own figures", "figures",
         2.0 + 1e-5 * static_cast<double>(artifact.mesh->triangles.size())}};
    for (const bench::SetUp& set_up : set_ups) {
        const std::vector<bench::WorkStep> more =
            bench::work_steps(set_up, *artifact.pack, *artifact.mesh, options);
        steps.insert(steps.end(), more.begin(), more.end());
    }
    return steps;
}

/// Measures the pack's own figures again, in mm on the first set-up's prop.
std::vector<bench::LimitVerdict> judge_figures(const LoadedArtifact& artifact, const bench::SetUp& set_up,
                                               BenchProgress& progress) {
    progress.show("the pack's own figures", 0.0);
    const std::vector<bench::LevelFigures> figures = bench::measure_figures(*artifact.pack, *artifact.mesh);
    progress.show("the pack's own figures", 1.0);
    progress.clear();
    const double mm_per_box =
        1e3 * pack::place(*artifact.pack, settings::make_prop(set_up.settings.prop)).metres_per_box;
    std::vector<bench::LimitVerdict> verdicts = bench::judge(figures, mm_per_box);
    fmt::print("Error figures in the pack, against those measured now\n{}\n", bench::lines_of(verdicts));
    return verdicts;
}

/// Measures one set-up, prints its table and adds its pictures to `files`.
Result<bench::SetUpResult> measure(const bench::SetUp& set_up, const LoadedArtifact& artifact,
                                   const bench::ErrorTimeOptions& options, BenchProgress& progress,
                                   std::vector<std::pair<std::string, std::string>>& files) {
    TRY(bench::SetUpResult result,
        bench::error_time(set_up, *artifact.pack, artifact.mesh, options,
                          [&](const std::string& step, double done) { progress.show(step, done); }));
    progress.clear();
    fmt::print("{}\n", bench::console_table(result));
    std::fflush(stdout);
    for (const auto& [level, picture] : result.worst) {
        files.emplace_back(fmt::format("worst_{}_{}.png", set_up.name, level),
                           as_text(image::encode_png(picture)));
    }
    return result;
}

Result<void> run(const Arguments& arguments, BenchProgress& progress) {
    TRY(const std::vector<bench::SetUp> set_ups, load_set_ups(arguments.place));
    TRY(const LoadedArtifact artifact, load_artifact(arguments.artifact));
    if (!artifact.pack->unlit) {
        fmt::print(stderr,
                   "frustumscreen-bench: {}: baked with light; levels are compared with that light at each "
                   "ray's hit, peers have "
                   "no light and are compared by shape alone\n",
                   arguments.artifact.pack.string());
    }
    progress.plan(all_steps(set_ups, artifact, arguments.options));
    const std::vector<bench::LimitVerdict> figures = judge_figures(artifact, set_ups.front(), progress);
    std::vector<bench::SetUpResult> results;
    std::vector<std::pair<std::string, std::string>> files;
    for (const bench::SetUp& set_up : set_ups) {
        TRY(bench::SetUpResult result, measure(set_up, artifact, arguments.options, progress, files));
        results.push_back(std::move(result));
    }
    files.emplace_back("error_time.csv", bench::summary_csv(results));
    files.emplace_back("error_time_poses.csv", bench::poses_csv(results));
    files.emplace_back("error_time.json", bench::report_json(results, artifact.pack->title, figures));
    files.emplace_back("verdicts.csv", bench::verdicts_csv(results, figures));
    files.emplace_back("limits.csv", bench::limits_csv());
    TRY_VOID(write_all(arguments.place.out, files));
    const Result<void> drawn = draw_all(arguments.place.out, {"error_time.csv"});
    const Result<void> figures_hold = bench::require_true(figures, arguments.artifact.pack.string());
    if (!figures_hold || !drawn) {
        return figures_hold ? drawn : figures_hold;
    }
    return arguments.limits == "all" ? bench::require_limits(results) : Result<void>{};
}

} // namespace

BenchCommand error_time_command(CommandLine& app) {
    CommandLine command = app.add_subcommand(
        "error-time",
        "measures error and frame time of every level of a pack and of its peers, against a ray cast");
    const auto arguments = std::make_shared<Arguments>();
    add_place_options(command, arguments->place);
    add_artifact_options(command, arguments->artifact);
    add_picture_options(command, arguments->options.picture);
    add_pose_options(command, arguments->options.poses, arguments->options.seed);
    command.add_flag("--timed-lit", arguments->options.picture.timed_lit,
                     "time levels and reliefs lit as visitors see them; peers are always unlit");
    command
        .add_option("--peers", arguments->peers,
                    "none, all, or a list of mesh, two-pass, ray-cast, lod, two-pass-lod, relief, "
                    "relief-cast, relief-gpu, separated by commas")
        .check({[](const std::string& words) {
                    const Result<bench::PeerChoice> choice = bench::parse_peers(words);
                    return choice ? std::string() : choice.error().message;
                },
                ""})
        .capture_default_str();
    command
        .add_option("--peer-samples", arguments->options.peers.samples,
                    "samples a pixel of the peers, a list of 1, 2, 4, 8, separated by commas (default: 1 and "
                    "what the pack asks for)")
        .delimiter(',')
        .one_of_numbers({1, 2, 4, 8});
    command
        .add_option("--limits", arguments->limits,
                    "all: exit status 1 if a limit is missed; none: measure only")
        .one_of({"all", "none"})
        .capture_default_str();
    return {command, [arguments](BenchProgress& progress) {
                std::vector<int> samples = std::move(arguments->options.peers.samples);
                arguments->options.peers =
                    *bench::parse_peers(arguments->peers); // validated by the option's check
                arguments->options.peers.samples = std::move(samples);
                return run(*arguments, progress);
            }};
}

} // namespace frustumscreen::programs
