#include "app/bench/torch/torch_bench.h"
#include "app/bench/torch/torch_wall.h"
#include "app/programs/bench/bench_board.h"
#include "app/programs/bench/bench_command.h"
#include "app/programs/common/command_line.h"
#include "app/render/read_back.h"
#include "firmware_host/base/file.h"

#include <memory>

namespace frustumscreen::programs {

namespace {

struct Arguments {
    std::filesystem::path out;
    std::filesystem::path config = "config/near.toml";
    BenchArtifact artifact;
    bench::TorchOptions options;
    bool is_long = false;
};

/// The middle frame of each scene, in its own colours: ours, and the paper's.
Result<void> write_pictures(bench::TorchSet& set, const bench::TorchOptions& options,
                            const std::filesystem::path& folder) {
    TRY(const std::vector<bench::TorchFrame> sweep,
        bench::draw_sweep(set.settings(), set.prop(), set.box(), options.frames, options.seed));
    const std::size_t middle = sweep.size() / 2;
    for (const bench::TorchScene& scene : set.scenes()) {
        const std::vector<double> tolerances(sweep.size(), 0.004);
        for (const bench::TorchWay& way :
             {bench::TorchWay{.name = "ours", .kind = bench::TorchWay::Kind::Ours},
              bench::TorchWay{
                  .name = "paper", .kind = bench::TorchWay::Kind::Paper, .tolerances = tolerances}}) {
            TRY(const std::unique_ptr<bench::TorchTechnique> technique,
                bench::TorchTechnique::create(set, scene, bench::sweep_beam(), way));
            technique->draw(sweep[middle], middle, false);
            image::Image8 picture;
            set.cells().read_colour_into(picture);
            TRY_VOID(write_file(folder / ("torch_" + scene.name + "_" + way.name + ".png"),
                                image::encode_png(picture)));
        }
    }
    return {};
}

Result<void> run(Arguments arguments, BenchProgress& progress) {
    TRY_VOID(check_board_options(arguments.artifact));
    if (arguments.is_long) {
        arguments.options.frames = 300;
        arguments.options.errors = 30;
    }
    TRY(const settings::CheckedSettings settings, settings::load_settings(arguments.config));
    TRY_VOID(write_all(arguments.out, {}));
    TRY_VOID(without_value(given_or_board(arguments.out, arguments.artifact, progress)));
    TRY(const std::unique_ptr<bench::TorchSet> set,
        bench::TorchSet::open(*settings, arguments.artifact.pack));
    TRY(const bench::TorchResult result,
        bench::measure_torch(*set, arguments.options,
                             [&](const std::string& step, double done) { progress.show(step, done); }));
    progress.clear();
    fmt::print("{}\n{}", bench::torch_table(result), bench::torch_verdicts(result));
    TRY_VOID(write_all(arguments.out, {{"torch.csv", bench::torch_csv(result)},
                                       {"torch_frames.csv", bench::torch_frames_csv(result)},
                                       {"torch_samples.csv", bench::torch_samples_csv(result)},
                                       {"torch_details.csv", bench::torch_details_csv(result)},
                                       {"torch_wall.csv", bench::torch_wall_csv(bench::measure_wall())},
                                       {"torch_triangles.csv", bench::torch_triangles_csv()}}));
    TRY_VOID(write_pictures(*set, arguments.options, arguments.out));
    return draw_all(arguments.out,
                    {"torch.csv", "torch_frames.csv", "torch_wall.csv", "torch_triangles.csv"});
}

} // namespace

BenchCommand torch_command(CommandLine& app) {
    CommandLine command = app.add_subcommand(
        "torch", "measures cost and error of a torch's light on polygons, relief and cells, against the "
                 "paper's splitting of triangles");
    const auto arguments = std::make_shared<Arguments>();
    command.add_option("--out", arguments->out, "folder for the tables, plots and pictures").required();
    add_board_options(command, arguments->artifact);
    command.add_option("--config", arguments->config, "settings of the set-up").capture_default_str();
    command.add_option("--frames", arguments->options.frames, "length of the sweep, at 15 frames a second")
        .within(2, 100000)
        .capture_default_str();
    command
        .add_option("--passes", arguments->options.passes,
                    "passes over the sweep; the least time of each frame counts")
        .within(1, 100)
        .capture_default_str();
    command.add_option("--errors", arguments->options.errors, "number of frames compared with the truth")
        .within(1, 100000)
        .capture_default_str();
    command.add_option("--seed", arguments->options.seed, "seed of the sweep").capture_default_str();
    command.add_flag("--long", arguments->is_long,
                     "a sweep of 300 frames, 30 of them compared with the truth");
    return {command, [arguments](BenchProgress& progress) { return run(*arguments, progress); }};
}

} // namespace frustumscreen::programs
