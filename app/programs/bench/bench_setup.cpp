#include "app/bench/setup/advice_report.h"
#include "app/programs/bench/bench_command.h"

#include <memory>

namespace frustumscreen {

namespace {

struct Arguments {
    std::filesystem::path out;
    std::filesystem::path config;
    std::vector<int> picture; ///< width, height; empty: that of the settings
    AdviceOptions options;
};

Result<void> run(const Arguments& arguments, BenchProgress& progress) {
    const Result<CheckedSettings> checked = load_settings(arguments.config);
    if (!checked) {
        return tl::unexpected<Error>(checked.error());
    }
    if (arguments.options.lowest_m > arguments.options.highest_m) {
        return bad_input("--lowest-m is above --highest-m; no lens can hang there");
    }
    const Settings& settings = **checked;
    AdviceOptions options = arguments.options;
    if (arguments.picture.size() == 2) {
        options.width = arguments.picture[0];
        options.height = arguments.picture[1];
    }
    const std::vector<SetUpChoice> found =
        choices(settings, options, [&progress](double done) { progress.show("set-ups", done); });
    progress.clear();
    fmt::print("{}\n", setup_table(settings, found, options));
    if (const SetUpChoice* best = best_of(found); best != nullptr && best->works) {
        fmt::print("{}", setup_toml(*best));
    } else {
        fmt::print("None works: hang the projector higher (--highest-m), take a wider table, or ask for less "
                   "(--evenness, "
                   "--pixels).\n");
    }
    Result<void> written = write_all(arguments.out, {{"setup.csv", setup_csv(settings, found)}});
    return written ? draw_all(arguments.out, {"setup.csv"}) : written;
}

} // namespace

BenchCommand setup_command(CLI::App& app) {
    CLI::App* command =
        app.add_subcommand("setup", "which prop and which place of the projector suit a table");
    const auto arguments = std::make_shared<Arguments>();
    command->add_option("--config", arguments->config, "settings: the table, the eyes, the prop as it is")
        ->required();
    command->add_option("--out", arguments->out, "folder for the table and the plot")->required();
    command
        ->add_option("--picture", arguments->picture, "width and height of the projector's picture, pixels")
        ->expected(2)
        ->check(CLI::Range(64, 8192));
    AdviceOptions& options = arguments->options;
    command->add_option("--lowest-m", options.lowest_m, "of the lens over the table")
        ->check(CLI::Range(0.3, 5.0))
        ->capture_default_str();
    command->add_option("--highest-m", options.highest_m, "of the lens over the table")
        ->check(CLI::Range(0.3, 5.0))
        ->capture_default_str();
    command->add_option("--sides-m", options.sides_m, "how far from the table's middle the lens may be")
        ->check(CLI::Range(0.0, 2.0))
        ->capture_default_str();
    command
        ->add_option("--evenness", options.evenness,
                     "light of the darkest face that is seen, as a share of the brightest one's")
        ->check(CLI::Range(0.05, 0.95))
        ->capture_default_str();
    command
        ->add_option("--pixels", options.pixels,
                     "projector pixels on the artifact, times as many as it has now")
        ->check(CLI::Range(0.1, 100.0))
        ->capture_default_str();
    return {command, [arguments](BenchProgress& progress) { return run(*arguments, progress); }};
}

} // namespace frustumscreen
