/// frustumscreen: the exhibit, and what it shows without devices.
#include "app/programs/guarded_main.h"
#include "app/programs/plan_command.h"
#include "app/programs/record_command.h"
#include "app/programs/render_command.h"
#include "app/programs/run_command.h"
#include "app/settings/config_json.h"
#include "app/settings/settings.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <cstdio>
#include <filesystem>
#include <string_view>

namespace frustumscreen {
namespace {

int config_command(int argc, char** argv) {
    CLI::App app("Prints the resolved, checked settings.", "frustumscreen config");
    std::filesystem::path file;
    bool json = false;
    app.add_option("--config", file, "the kiosk's settings, TOML")->required();
    app.add_flag("--json", json, "as JSON (the only form)");
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        return app.exit(error) == 0 ? 0 : 2;
    }
    const Result<CheckedSettings> settings = load_settings(file);
    if (!settings) {
        fmt::print(stderr, "frustumscreen: {}\n", settings.error().message);
        return 1;
    }
    fmt::print("{}", config_json(*settings));
    return 0;
}

void print_usage(std::FILE* to) {
    fmt::print(to, "usage: frustumscreen run|record|render|plan|config [--help] ...\n"
                   "  run     the exhibit\n"
                   "  record  what the tracker sends, into a file\n"
                   "  render  a pose file into pictures, without devices\n"
                   "  plan    what a scene needs, what it leaves out, and what that saves\n"
                   "  config  the resolved, checked settings\n"
                   "  --version\n");
}

int dispatch(int argc, char** argv) {
    const std::string_view command = argc > 1 ? argv[1] : "";
    if (command == "render") {
        return render_command(argc - 1, argv + 1);
    }
    if (command == "config") {
        return config_command(argc - 1, argv + 1);
    }
    if (command == "run") {
        return run_command(argc - 1, argv + 1);
    }
    if (command == "record") {
        return record_command(argc - 1, argv + 1);
    }
    if (command == "plan") {
        return plan_command(argc - 1, argv + 1);
    }
    if (command == "--help" || command == "-h") {
        print_usage(stdout);
        return 0;
    }
    if (command == "--version") {
        fmt::print("frustumscreen {}\n", FRUSTUMSCREEN_VERSION);
        return 0;
    }
    print_usage(stderr);
    return 2;
}

} // namespace
} // namespace frustumscreen

int main(int argc, char** argv) {
    return frustumscreen::guarded_main("frustumscreen", frustumscreen::dispatch, argc, argv);
}
