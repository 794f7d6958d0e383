#include "app/bench/ldi/ldi_bench.h"
#include "app/programs/bench/bench_command.h"
#include "app/programs/common/command_line.h"
#include "firmware_host/base/file.h"

#include <memory>

namespace frustumscreen::programs {

namespace {

struct Arguments {
    std::filesystem::path out;
    std::filesystem::path config = "config/near.toml";
    bench::LdiOptions options;
    std::size_t triangles = 0; ///< 0: the report's three
    bool is_long = false;
};

Result<void> run(Arguments arguments, BenchProgress& progress) {
    if (arguments.triangles > 0) {
        arguments.options.triangles = {arguments.triangles};
    }
    if (arguments.is_long) {
        arguments.options.frames = 200;
        arguments.options.errors = 60;
        arguments.options.eyes_in_patch = 8;
        arguments.options.coarse = true;
        arguments.options.resolutions = {128, 256, 512};
    }
    TRY(const settings::CheckedSettings settings, settings::load_settings(arguments.config));
    TRY_VOID(write_all(arguments.out, {}));
    TRY(const bench::LdiResult result,
        bench::measure_ldi(*settings, arguments.options,
                           [&](const std::string& step, double done) { progress.show(step, done); }));
    progress.clear();
    fmt::print("{}{}", bench::ldi_table(result), bench::ldi_verdicts(result));
    TRY_VOID(write_all(arguments.out, {{"ldi.csv", bench::ldi_csv(result)},
                                       {"ldi_error.csv", bench::ldi_error_csv(result)}}));
    for (const bench::LdiPicture& each : result.pictures) {
        TRY_VOID(write_file(arguments.out / ("ldi_" + each.name + ".png"), image::encode_png(each.picture)));
    }
    return draw_all(arguments.out, {"ldi.csv", "ldi_error.csv"});
}

} // namespace

BenchCommand ldi_command(CommandLine& app) {
    CommandLine command = app.add_subcommand(
        "ldi", "measures cost and error of frozen windows: as triangles, as layered depth images, as the "
               "exhibit draws them, and as engines do");
    const auto arguments = std::make_shared<Arguments>();
    command.add_option("--out", arguments->out, "folder for the tables, plots and pictures").required();
    command.add_option("--config", arguments->config, "settings of the scene alone").capture_default_str();
    command
        .add_option("--triangles", arguments->triangles,
                    "triangles of one scene (default: 126790, 264247 and 630799, as in the report)")
        .within(std::size_t{42'000}, std::size_t{5'000'000});
    command.add_option("--pixels", arguments->options.pixels, "pixels along each side of a window")
        .within(64, 1024)
        .capture_default_str();
    command.add_option("--frames", arguments->options.frames, "length of the eye's path")
        .within(2, 100000)
        .capture_default_str();
    command
        .add_option("--passes", arguments->options.passes,
                    "passes over the path; the least time of each frame counts")
        .within(1, 100)
        .capture_default_str();
    command.add_option("--errors", arguments->options.errors, "number of frames compared with a ray cast")
        .within(1, 100000)
        .capture_default_str();
    command.add_option("--seed", arguments->options.seed, "seed of the scene and the path")
        .capture_default_str();
    command.add_flag(
        "--long", arguments->is_long,
        "a path of 200 frames, 60 of them compared with a ray cast, 8 eyes in each patch, windows of "
        "512 pixels and reliefs with coarser texels");
    return {command, [arguments](BenchProgress& progress) { return run(*arguments, progress); }};
}

} // namespace frustumscreen::programs
