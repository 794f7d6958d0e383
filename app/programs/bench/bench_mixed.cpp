#include "app/bench/mixed/mixed.h"
#include "app/programs/bench/bench_board.h"
#include "app/programs/bench/bench_command.h"
#include "app/programs/common/command_line.h"

#include <memory>

namespace frustumscreen::programs {

namespace {

struct Arguments {
    std::filesystem::path out;
    std::filesystem::path config = "config/near.toml";
    BenchArtifact artifact;
    bench::MixedOptions options;
    bool is_long = false;
};

Result<void> make_folder(const std::filesystem::path& folder) {
    return write_all(folder, {});
}

Result<void> run(Arguments arguments, BenchProgress& progress) {
    TRY_VOID(check_board_options(arguments.artifact));
    if (arguments.is_long) {
        arguments.options.frames = 600;
        arguments.options.steps = 15;
        arguments.options.budgets = 8;
    }
    TRY(const settings::CheckedSettings settings, settings::load_settings(arguments.config));
    TRY_VOID(make_folder(arguments.out));
    TRY(const std::shared_ptr<const bake::SourceMesh> mesh,
        given_or_board(arguments.out, arguments.artifact, progress));
    TRY(const bench::MixedResult result,
        bench::measure_mixed(*settings, arguments.artifact.pack, mesh, arguments.options,
                             [&](const std::string& step, double done) { progress.show(step, done); }));
    progress.clear();
    fmt::print("{}\n{}", bench::mixed_table(result), bench::mixed_verdicts(result));
    TRY_VOID(write_all(arguments.out, {{"mixed.csv", bench::mixed_csv(result)},
                                       {"mixed_frames.csv", bench::mixed_frames_csv(result)}}));
    return draw_all(arguments.out, {"mixed.csv", "mixed_frames.csv"});
}

} // namespace

BenchCommand mixed_command(CommandLine& app) {
    CommandLine command = app.add_subcommand(
        "mixed",
        "measures how the cells of an artifact are drawn, each as polygons or relief, at several budgets "
        "of time, against the paper's choice");
    const auto arguments = std::make_shared<Arguments>();
    command.add_option("--out", arguments->out, "folder for the tables and plots").required();
    add_board_options(command, arguments->artifact);
    command.add_option("--config", arguments->config, "settings of the set-up").capture_default_str();
    command.add_option("--frames", arguments->options.frames, "length of the walk, at 60 frames a second")
        .within(2, 100000)
        .capture_default_str();
    command
        .add_option("--steps", arguments->options.steps,
                    "number of settings of each technique's own budget, from least to most")
        .within(1, 100)
        .capture_default_str();
    command.add_option("--seed", arguments->options.seed, "seed of the walk").capture_default_str();
    command.add_flag("--long", arguments->is_long, "a walk of 600 frames at eight budgets");
    return {command, [arguments](BenchProgress& progress) { return run(*arguments, progress); }};
}

} // namespace frustumscreen::programs
