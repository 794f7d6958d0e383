#include "app/programs/frustumscreen/config/config_command.h"

#include "app/programs/common/command_line.h"
#include "app/programs/common/guarded_main.h"
#include "app/programs/frustumscreen/config/judgement.h"
#include "app/programs/frustumscreen/drawing/setup_page.h"
#include "app/settings/config_json.h"
#include "app/settings/missing_files.h"
#include "app/settings/settings_page.h"
#include "firmware_host/base/local_time.h"
#include "firmware_host/base/standard_error.h"

#include <fmt/format.h>

#include <chrono>
#include <filesystem>
#include <optional>

namespace frustumscreen::programs {

namespace {

struct Request {
    std::filesystem::path config;
    bool json = false; ///< the default
    bool explain = false;
    bool describe = false;
};

std::optional<int> read_arguments(int argc, char** argv, Request& request) {
    CommandLine app("Prints the checked settings with their defaults, explains them, or lists all settings.",
                    "frustumscreen config");
    app.add_option("--config", request.config, "the kiosk's settings, TOML");
    const CommandOption json =
        app.add_flag("--json", request.json, "print the settings as JSON (the default)");
    const CommandOption explain = app.add_flag(
        "--explain", request.explain,
        "explain in words: the picture on the table, the light on the prop, the zone, and what to check");
    app.add_flag("--describe", request.describe,
                 "list every setting with its default and meaning; needs no --config")
        .excludes(json)
        .excludes(explain);
    explain.excludes(json);
    return app.end_of_arguments(argc, argv, [&] {
        if (request.config.empty() && !request.describe) {
            throw missing("--config");
        }
    });
}

Result<void> print_config(const Request& request) {
    if (request.describe) {
        fmt::print("{}", settings::settings_page());
        return {};
    }
    TRY(const settings::CheckedSettings settings, settings::load_settings(request.config));
    for (const std::string& missing : settings::missing_files(*settings)) {
        say_line("frustumscreen", missing);
    }
    if (!request.explain) {
        fmt::print("{}", settings::config_json(settings));
        return {};
    }
    const std::string& zone = settings->hours.time_zone;
    static_cast<void>(zone.empty() || use_time_zone(zone)); // load_settings has reported a missing time zone
    const auto now = std::chrono::floor<std::chrono::seconds>(std::chrono::system_clock::now());
    fmt::print("{}{}", setup_page(*settings), judgement_page(*settings, now));
    return {};
}

} // namespace

int config_command(int argc, char** argv) {
    Request request;
    if (const std::optional<int> end = read_arguments(argc, argv, request)) {
        return *end;
    }
    return exit_status("frustumscreen", print_config(request));
}

} // namespace frustumscreen::programs
