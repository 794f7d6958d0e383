#include "app/bench/guidance/guidance_report.h"
#include "app/bench/truth/seeded_situations.h"
#include "app/exhibit/guidance_setup.h"
#include "app/programs/bench/bench_command.h"
#include "app/programs/common/command_line.h"
#include "app/settings/whole_zone.h"

#include <memory>

namespace frustumscreen::programs {

namespace {

struct Arguments {
    std::filesystem::path out;
    std::filesystem::path config;
    bench::GuidanceOptions options;
};

/// Each prop twice: without an artifact, where every visible face counts, and with one, where the artifact counts.
using NamedSetups = std::vector<std::pair<std::string, guidance::GuidanceSetup>>;
NamedSetups without_and_with_artifact(const std::string& name, const settings::Settings& settings) {
    NamedSetups setups{{name, exhibit::guidance_setup(settings)},
                       {name + " with an artifact", exhibit::guidance_setup(settings)}};
    setups.back().second.hull = settings::usual_artifact(setups.back().second.prop);
    return setups;
}

Result<NamedSetups> setups_of(const Arguments& arguments) {
    if (!arguments.config.empty()) {
        TRY(const settings::CheckedSettings checked, settings::load_settings(arguments.config));
        return without_and_with_artifact(arguments.config.stem().string(), *checked);
    }
    NamedSetups setups = without_and_with_artifact("frustum on the table", settings::Settings{});
    setups.emplace_back("cube in the hand", exhibit::guidance_setup(bench::cube_in_hand()));
    return setups;
}

Result<void> run(const Arguments& arguments, BenchProgress& progress) {
    TRY(const NamedSetups props, setups_of(arguments));
    std::vector<bench::GuidedProp> results;
    for (const auto& [name, setup] : props) {
        results.push_back(
            bench::measure_guidance(name, setup, arguments.options,
                                    [&progress, &name = name](double done) { progress.show(name, done); }));
        progress.clear();
        fmt::print("{}{}\n", bench::guidance_table(results.back()),
                   bench::lines_of(bench::judge(results.back())));
    }
    Result<void> written = write_all(arguments.out, {{"guidance.csv", bench::guidance_csv(results)}});
    return written ? draw_all(arguments.out, {"guidance.csv"}) : written;
}

} // namespace

BenchCommand guidance_command(CommandLine& app) {
    CommandLine command = app.add_subcommand(
        "guidance", "measures the effect of advice, in random situations and for simulated visitors");
    const auto arguments = std::make_shared<Arguments>();
    command.add_option("--out", arguments->out, "folder for the table and the plot").required();
    command.add_option(
        "--config", arguments->config,
        "settings; without it the shipped set-up, without and with an artifact, and a cube in the hand");
    command.add_option("--situations", arguments->options.situations, "random situations for each prop")
        .within(1, 10000000)
        .capture_default_str();
    command
        .add_option("--visitors", arguments->options.visitors,
                    "simulated visitors for each prop and kind of advice")
        .within(1, 100000)
        .capture_default_str();
    command.add_option("--seconds", arguments->options.seconds, "length of each visit")
        .within(5.0, 3600.0)
        .capture_default_str();
    command.add_option("--seed", arguments->options.seed, "seed of situations and visitors")
        .capture_default_str();
    return {command, [arguments](BenchProgress& progress) { return run(*arguments, progress); }};
}

} // namespace frustumscreen::programs
