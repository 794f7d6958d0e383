#include "app/bench/measures/coverage.h"
#include "app/programs/bench/bench_command.h"
#include "app/programs/common/command_line.h"

#include <memory>

namespace frustumscreen::programs {

namespace {

struct Arguments {
    BenchPlace place;
    std::vector<std::filesystem::path> packs, meshes;
    bench::EstimateOptions options;
    std::string limits = "all";
};

/// Measures one pack in every set-up, prints its table and appends each pose's values to `poses`.
Result<std::vector<bench::NamedCoverage>> measure(const BenchArtifact& named,
                                                  const std::vector<bench::SetUp>& set_ups,
                                                  const bench::EstimateOptions& options,
                                                  BenchProgress& progress, std::string& poses) {
    TRY(const LoadedArtifact artifact, load_artifact(named));
    const std::string name = named.pack.stem().string();
    std::vector<bench::NamedCoverage> rows;
    for (const bench::SetUp& set_up : set_ups) {
        TRY(const bench::SetUpResult result,
            bench::measure_estimates(
                set_up, *artifact.pack, artifact.mesh, options,
                [&](const std::string& step, double done) { progress.show(step, done); }));
        const std::vector<bench::NamedCoverage> more = bench::coverages_of(name, result);
        rows.insert(rows.end(), more.begin(), more.end());
        poses += bench::estimates_csv(name, result);
    }
    progress.clear();
    fmt::print("{}\n", bench::coverage_table(rows));
    std::fflush(stdout);
    return rows;
}

Result<void> run(const Arguments& arguments, BenchProgress& progress) {
    if (arguments.packs.size() != arguments.meshes.size()) {
        return bad_input("bench.packs_and_meshes",
                         "there are {} packs and {} meshes; give each --pack its --mesh, in the same order",
                         arguments.packs.size(), arguments.meshes.size());
    }
    TRY(const std::vector<bench::SetUp> set_ups, load_set_ups(arguments.place));
    std::vector<bench::NamedCoverage> rows;
    std::string poses(bench::estimates_csv_header);
    for (std::size_t k = 0; k < arguments.packs.size(); ++k) {
        TRY(const std::vector<bench::NamedCoverage> more,
            measure({arguments.packs[k], arguments.meshes[k]}, set_ups, arguments.options, progress, poses));
        rows.insert(rows.end(), more.begin(), more.end());
    }
    const bench::LimitVerdict verdict = bench::judge(rows);
    fmt::print("{}", bench::lines_of(std::span(&verdict, 1)));
    Result<void> written = write_all(
        arguments.place.out, {{"estimate.csv", bench::coverage_csv(rows)}, {"estimate_poses.csv", poses}});
    if (written && !verdict.held && arguments.limits == "all") {
        return fail(ErrorKind::Internal, "bench.estimate_limits", "{} ({}); --limits none only measures",
                    verdict.what, verdict.found);
    }
    return written;
}

} // namespace

BenchCommand estimate_command(CommandLine& app) {
    CommandLine command = app.add_subcommand(
        "estimate",
        "measures the exhibit's estimate of its picture error, level by level, against a ray cast");
    const auto arguments = std::make_shared<Arguments>();
    add_place_options(command, arguments->place);
    command.add_option("--pack", arguments->packs, "one or several packs").required();
    command.add_option("--mesh", arguments->meshes, "file that each pack was baked from, in the same order")
        .required();
    add_pose_options(command, arguments->options.poses, arguments->options.seed);
    command.add_option("--rays", arguments->options.rays, "rays per pixel for the true mean error")
        .one_of_numbers({1, 2, 4, 8, 16})
        .capture_default_str();
    command
        .add_option("--limits", arguments->limits,
                    "all: exit status 1 if too few poses are covered; none: measure only")
        .one_of({"all", "none"})
        .capture_default_str();
    return {command, [arguments](BenchProgress& progress) { return run(*arguments, progress); }};
}

} // namespace frustumscreen::programs
