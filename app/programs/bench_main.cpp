/// frustumscreen-bench: error against run time and scaling, as tables and plots.
#include "app/bench/report.h"
#include "app/bench/scaling.h"
#include "app/bench/verdicts.h"
#include "app/settings/settings.h"
#include "assets_baked/artifacts/builtin.h"
#include "assets_baked/bake/bake.h"
#include "assets_baked/bake/load_mesh.h"
#include "firmware_host/base/file.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <filesystem>
#include <string>
#include <vector>

namespace {

using namespace frustumscreen;

struct Arguments {
    std::filesystem::path pack;
    std::filesystem::path mesh;
    std::vector<std::filesystem::path> configs;
    std::filesystem::path out;
    ErrorTimeOptions error_time;
    ScalingOptions scaling;
    bool no_peers = false;
    PictureOptions picture;
};

/// One line that is written over while a person waits longer than two seconds; silent in a pipe.
class ProgressLine {
public:
    void show(const std::string& step, double done) {
        const auto now = std::chrono::steady_clock::now();
        if (step != step_) {
            step_ = step;
            begun_ = now;
        }
        const double passed_s = std::chrono::duration<double>(now - begun_).count();
        if (!on_terminal_ || now - started_ < std::chrono::seconds(2)) {
            return;
        }
        const int left_s = done > 0.0 ? static_cast<int>(passed_s * (1.0 - done) / done) : 0;
        fmt::print(stderr, "\r\033[K{:3.0f} %  {}{}", done * 100.0, step,
                   done > 0.02 ? fmt::format(", {}:{:02} left", left_s / 60, left_s % 60) : std::string());
        std::fflush(stderr);
        written_ = true;
    }
    void clear() {
        if (written_) {
            fmt::print(stderr, "\r\033[K");
            written_ = false;
        }
    }
    ~ProgressLine() { clear(); }

private:
    bool on_terminal_ = ::isatty(STDERR_FILENO) != 0;
    bool written_ = false;
    std::string step_;
    std::chrono::steady_clock::time_point started_ = std::chrono::steady_clock::now();
    std::chrono::steady_clock::time_point begun_ = started_;
};

Result<std::vector<SetUp>> load_set_ups(const std::vector<std::filesystem::path>& configs) {
    std::vector<SetUp> set_ups;
    for (const std::filesystem::path& config : configs) {
        const Result<CheckedSettings> settings = load_settings(config);
        if (!settings) {
            return tl::unexpected<Error>(settings.error());
        }
        set_ups.push_back({config.stem().string(), **settings});
    }
    return set_ups;
}

/// Files in --out, all or the first that fails.
Result<void> write_all(const std::filesystem::path& folder,
                       const std::vector<std::pair<std::string, std::string>>& files) {
    std::error_code made;
    std::filesystem::create_directories(folder, made);
    if (made) {
        return bad_input(folder.string() + ": this folder cannot be made: " + made.message());
    }
    for (const auto& [name, text] : files) {
        if (const Result<void> written = write_file(folder / name, as_bytes(text)); !written) {
            return written;
        }
    }
    return {};
}

Result<void> run_error_time(const Arguments& arguments, ProgressLine& progress) {
    const Result<std::vector<SetUp>> set_ups = load_set_ups(arguments.configs);
    if (!set_ups) {
        return tl::unexpected<Error>(set_ups.error());
    }
    const Result<VerifiedPack> pack = load_pack(arguments.pack);
    if (!pack) {
        return tl::unexpected<Error>(pack.error());
    }
    if (!(*pack)->unlit) {
        fmt::print(
            stderr,
            "frustumscreen-bench: {}: baked with light, so its colour errors say nothing; bake it with "
            "--unlit\n",
            arguments.pack.string());
    }
    Result<SourceMesh> loaded = load_mesh(arguments.mesh);
    if (!loaded) {
        return tl::unexpected<Error>(loaded.error());
    }
    const auto mesh = std::make_shared<const SourceMesh>(std::move(*loaded));
    std::vector<SetUpResult> results;
    std::vector<std::pair<std::string, std::string>> files;
    for (const SetUp& set_up : *set_ups) {
        Result<SetUpResult> result =
            error_time(set_up, **pack, mesh, arguments.error_time,
                       [&](const std::string& step, double done) { progress.show(step, done); });
        if (!result) {
            return tl::unexpected<Error>(result.error());
        }
        progress.clear();
        fmt::print("{}\n", console_table(*result));
        std::fflush(stdout);
        files.emplace_back("error_time_" + set_up.name + ".svg", error_time_svg(*result, (*pack)->title));
        results.push_back(std::move(*result));
    }
    files.emplace_back("error_time.csv", summary_csv(results));
    files.emplace_back("error_time_poses.csv", poses_csv(results));
    files.emplace_back("error_time.json", report_json(results, (*pack)->title));
    return write_all(arguments.out, files);
}

/// The amphora of a million triangles against the two-pass method at each of its eye images.
Result<SetUpResult> against_two_pass(const SetUp& set_up, const Arguments& arguments,
                                     ProgressLine& progress) {
    const auto show = [&](const std::string& step, double done) { progress.show(step, done); };
    Result<SourceMesh> made = make_builtin("amphora", 1'000'000);
    if (!made) {
        return tl::unexpected<Error>(made.error());
    }
    const auto mesh = std::make_shared<const SourceMesh>(std::move(*made));
    BakeOptions options;
    options.size = arguments.scaling.size;
    options.unlit = true;
    options.progress = [&](std::string_view step, double done) { show("bake: " + std::string(step), done); };
    const Result<Pack> pack = bake(*mesh, options);
    if (!pack) {
        return tl::unexpected<Error>(pack.error());
    }
    ErrorTimeOptions compared = arguments.error_time;
    compared.poses = arguments.scaling.poses;
    compared.seed = arguments.scaling.seed;
    return error_time(set_up, *pack, mesh, compared, show);
}

Result<void> run_scaling(const Arguments& arguments, ProgressLine& progress) {
    const Result<std::vector<SetUp>> set_ups = load_set_ups(arguments.configs);
    if (!set_ups) {
        return tl::unexpected<Error>(set_ups.error());
    }
    std::vector<std::pair<std::string, std::string>> files;
    for (const SetUp& set_up : *set_ups) {
        const Result<std::vector<ScalingRow>> rows =
            scaling(set_up, arguments.scaling, [&](const std::string& step, double done) {
                progress.show(set_up.name + ": " + step, done);
            });
        if (!rows) {
            return at(set_up.name, rows.error());
        }
        progress.clear();
        fmt::print("{} set-up\n{}\n", set_up.name, scaling_table(*rows));
        std::fflush(stdout);
        files.emplace_back("scaling_" + set_up.name + ".csv", scaling_csv(*rows));
        files.emplace_back("scaling_" + set_up.name + ".svg", scaling_svg(*rows));
        if (arguments.no_peers) {
            continue;
        }
        const Result<SetUpResult> compared = against_two_pass(set_up, arguments, progress);
        if (!compared) {
            return tl::unexpected<Error>(compared.error());
        }
        progress.clear();
        fmt::print("built-in amphora, 1M triangles\n{}\n", console_table(*compared));
        files.emplace_back("two_pass_" + set_up.name + ".csv", summary_csv({&*compared, 1}));
        files.emplace_back("two_pass_" + set_up.name + ".svg",
                           error_time_svg(*compared, "Amphora, 1M triangles"));
    }
    return write_all(arguments.out, files);
}

void add_options(CLI::App& error_time, CLI::App& scaling, Arguments& arguments) {
    for (CLI::App* command : {&error_time, &scaling}) {
        command->add_option("--out", arguments.out, "folder for the tables and plots")->required();
        command->add_option(
            "--config", arguments.configs,
            "settings of a set-up; may be repeated (default: config/near.toml, config/kiosk.toml)");
        command->add_flag("--no-peers", arguments.no_peers,
                          "leave out the full mesh and the two-pass method");
    }
    for (CLI::App* command : {&error_time, &scaling}) {
        command
            ->add_option("--samples", arguments.picture.samples,
                         "samples a pixel; 0 = what the pack asks for")
            ->check(CLI::IsMember({0, 1, 2, 4, 8, 16}))
            ->capture_default_str();
        command->add_option("--anisotropy", arguments.picture.filter.anisotropy, "of the levels' textures")
            ->check(CLI::Range(1.0F, 16.0F))
            ->capture_default_str();
        command->add_option("--level-bias", arguments.picture.filter.level_bias, "of the levels' mipmaps")
            ->check(CLI::Range(-2.0F, 2.0F))
            ->capture_default_str();
    }
    error_time.add_option("--pack", arguments.pack, "pack, baked with --unlit")->required();
    error_time.add_option("--mesh", arguments.mesh, "the file that the pack was baked from")->required();
    error_time.add_option("--poses", arguments.error_time.poses, "poses of prop and eye")
        ->check(CLI::Range(1, 10000))
        ->capture_default_str();
    error_time.add_option("--seed", arguments.error_time.seed, "of the poses")->capture_default_str();
    scaling.add_option("--poses", arguments.scaling.poses, "poses of prop and eye")
        ->check(CLI::Range(1, 10000))
        ->capture_default_str();
    scaling.add_option("--seed", arguments.scaling.seed, "of the poses")->capture_default_str();
    scaling
        .add_option("--size", arguments.scaling.size, "of the bakes, texels along the longest edge of a face")
        ->check(CLI::Range(16, 4096))
        ->capture_default_str();
    scaling.add_option("--triangles", arguments.scaling.triangles, "counts of source triangles")
        ->check(CLI::Range(1000, 20'000'000))
        ->capture_default_str();
}

} // namespace

int main(int argc, char** argv) {
    Arguments arguments;
    CLI::App app("Measures the FrustumScreen's picture: error against run time, scaling.",
                 "frustumscreen-bench");
    app.set_version_flag("--version", FRUSTUMSCREEN_VERSION);
    app.require_subcommand(1);
    CLI::App* error_time =
        app.add_subcommand("error-time", "every level of a pack and its peers against a ray cast");
    CLI::App* scaling = app.add_subcommand("scaling", "cost against the source's size, built-in amphora");
    add_options(*error_time, *scaling, arguments);
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        return app.exit(error) == 0 ? 0 : 2;
    }
    if (arguments.configs.empty()) {
        arguments.configs = {"config/near.toml", "config/kiosk.toml"};
    }
    arguments.error_time.peers = !arguments.no_peers;
    arguments.error_time.picture = arguments.picture;
    arguments.scaling.picture = arguments.picture;
    ProgressLine progress;
    const Result<void> done =
        error_time->parsed() ? run_error_time(arguments, progress) : run_scaling(arguments, progress);
    if (!done) {
        progress.clear();
        fmt::print(stderr, "frustumscreen-bench: {}\n", done.error().message);
        return 1;
    }
    return 0;
}
