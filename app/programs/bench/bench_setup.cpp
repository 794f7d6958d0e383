#include "app/bench/setup/advice_report.h"
#include "app/bench/setup/zones_by_throw.h"
#include "app/pack/pack_file.h"
#include "app/programs/bench/bench_command.h"
#include "app/programs/common/command_line.h"

#include <memory>
#include <optional>

namespace frustumscreen::programs {

namespace {

struct Arguments {
    std::filesystem::path out;
    std::filesystem::path config;
    std::filesystem::path pack;       ///< the pack whose frames are timed; empty: none
    std::vector<int> picture;         ///< width, height; empty: the settings'
    std::vector<double> zone_m;       ///< width, depth; empty: not required
    std::vector<double> throw_ratios; ///< empty: choices are searched
    bench::AdviceOptions options;
};

constexpr std::size_t max_timed = 5;

/// Times a frame of the pack in the settings as they are and in the best choices.
Result<void> measure_costs(const pack::Pack& pack, bench::SetUpChoice& now,
                           std::vector<bench::SetUpChoice>& found, BenchProgress& progress) {
    std::vector<bench::SetUpChoice*> timed = bench::best_working(found, max_timed);
    timed.insert(timed.begin(), &now);
    std::vector<const settings::Settings*> set_ups;
    for (const bench::SetUpChoice* choice : timed) {
        set_ups.push_back(&choice->settings);
    }
    TRY(const std::vector<bench::SetUpCost> costs,
        bench::frame_costs(set_ups, pack, [&progress](double done) { progress.show("frames", done); }));
    for (std::size_t k = 0; k < timed.size(); ++k) {
        timed[k]->cost = costs[k];
    }
    return {};
}

Result<std::optional<pack::VerifiedPack>> load_if_named(const std::filesystem::path& file) {
    if (file.empty()) {
        return std::optional<pack::VerifiedPack>();
    }
    TRY(pack::VerifiedPack pack, pack::load_pack(file));
    return std::optional(std::move(pack));
}

Result<void> run(const Arguments& arguments, BenchProgress& progress) {
    TRY(const settings::CheckedSettings checked, settings::load_settings(arguments.config));
    if (arguments.options.lowest_m > arguments.options.highest_m) {
        return bad_input("bench.heights", "--lowest-m is above --highest-m; give a lower --lowest-m");
    }
    const settings::Settings& settings = *checked;
    if (!arguments.throw_ratios.empty()) {
        const std::vector<bench::ThrowZone> zones = bench::zones_by_throw(settings, arguments.throw_ratios);
        fmt::print("{}", bench::zones_table(zones));
        return write_all(arguments.out, {{"zones.csv", bench::zones_csv(zones)}});
    }
    bench::AdviceOptions options = arguments.options;
    if (arguments.picture.size() == 2) {
        options.width = arguments.picture[0];
        options.height = arguments.picture[1];
    }
    if (arguments.zone_m.size() == 2) {
        options.zone_m = {arguments.zone_m[0], arguments.zone_m[1]};
    }
    TRY(const std::optional<pack::VerifiedPack> pack, load_if_named(arguments.pack));
    bench::SetUpChoice now = bench::as_it_is(settings);
    std::vector<bench::SetUpChoice> found =
        bench::choices(settings, options, [&progress](double done) { progress.show("set-ups", done); });
    if (pack) {
        TRY_VOID(measure_costs(**pack, now, found, progress));
    }
    progress.clear();
    fmt::print("{}\n", bench::setup_table(now, found, options));
    if (!pack) {
        fmt::print("The cost of a frame is not measured; give a pack with --pack to measure it.\n\n");
    }
    if (const bench::SetUpChoice* best = bench::best_of(found); best != nullptr && best->works) {
        fmt::print("{}", bench::setup_toml(*best));
    } else {
        fmt::print("No choice meets the limits: hang the projector higher (--highest-m), take a wider table, "
                   "or lower "
                   "the limits (--evenness, --pixels).\n");
    }
    Result<void> written = write_all(arguments.out, {{"setup.csv", bench::setup_csv(now, found)}});
    return written ? draw_all(arguments.out, {"setup.csv"}) : written;
}

} // namespace

BenchCommand setup_command(CommandLine& app) {
    CommandLine command =
        app.add_subcommand("setup", "finds the prop and the place of the projector that suit a table");
    const auto arguments = std::make_shared<Arguments>();
    command.add_option("--config", arguments->config, "present settings: table, eyes, prop").required();
    command.add_option("--out", arguments->out, "folder for the table and the plot").required();
    command.add_option(
        "--pack", arguments->pack,
        "pack whose frames are timed in the best choices, as a multiple of the present settings' time");
    command.add_option("--picture", arguments->picture, "width and height of the projector's picture, pixels")
        .expected(2)
        .within(64, 8192);
    command
        .add_option("--zone-m", arguments->zone_m,
                    "width and depth of a zone in which all eyes see an artifact whole: artifacts may be "
                    "smaller then, and the picture wider")
        .expected(2)
        .within(0.01, 5.0);
    command
        .add_option("--throw-ratios", arguments->throw_ratios,
                    "search nothing, and measure the zone of the present lens and prop at these throw ratios")
        .within(0.2, 10.0);
    bench::AdviceOptions& options = arguments->options;
    command.add_option("--artifact-m", options.artifact_m, "least height of the artifact, with --zone-m")
        .within(0.02, 1.0)
        .capture_default_str();
    command.add_option("--lowest-m", options.lowest_m, "least height of the lens above the table")
        .within(0.3, 5.0)
        .capture_default_str();
    command.add_option("--highest-m", options.highest_m, "greatest height of the lens above the table")
        .within(0.3, 5.0)
        .capture_default_str();
    command.add_option("--sides-m", options.sides_m, "greatest distance of the lens from the table's middle")
        .within(0.0, 2.0)
        .capture_default_str();
    command
        .add_option("--evenness", options.evenness,
                    "least light of the darkest seen face, as a share of the brightest face's")
        .within(0.05, 0.95)
        .capture_default_str();
    command
        .add_option("--pixels", options.pixels,
                    "least number of projector pixels on the artifact, as a multiple of the present number")
        .within(0.1, 100.0)
        .capture_default_str();
    return {command, [arguments](BenchProgress& progress) { return run(*arguments, progress); }};
}

} // namespace frustumscreen::programs
