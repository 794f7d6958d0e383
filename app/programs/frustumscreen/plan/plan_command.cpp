#include "app/programs/frustumscreen/plan/plan_command.h"

#include "app/programs/common/argument_checks.h"
#include "app/programs/common/command_line.h"
#include "app/programs/common/guarded_main.h"
#include "app/programs/devices/wiring.h"
#include "app/programs/frustumscreen/plan/plan_report.h"
#include "app/scene/device_plan.h"
#include "app/settings/settings.h"

#include <fmt/format.h>

#include <cstdio>
#include <optional>

namespace frustumscreen::programs {

namespace {

struct Request {
    std::filesystem::path config;
    std::filesystem::path pack;
    std::string technique = "auto";
    bool json = false;
};

std::optional<int> read_arguments(int argc, char** argv, Request& request) {
    CommandLine app("Lists what the exhibit loads from a pack and opens on this machine, what it leaves out "
                    "and why, and measures the saving.",
                    "frustumscreen plan");
    app.add_option("--config", request.config, "the kiosk's settings, TOML").required();
    app.add_option("--pack", request.pack, "pack of the artifact, *.fspack (default: the settings' first)");
    app.add_option("--technique", request.technique,
                   "quality level to draw: auto, finest, level0, level1, ..., relief, relief96, ..., "
                   "relief-gpu, relief96-gpu, ...")
        .check(is_technique_word())
        .capture_default_str();
    app.add_flag("--json", request.json, "print the report as JSON");
    return app.end_of_arguments(argc, argv);
}

Result<void> plan(Request request) {
    TRY(const settings::CheckedSettings settings, settings::load_settings(request.config));
    if (request.pack.empty()) {
        if (settings->exhibit.packs.empty()) {
            return bad_input("plan.no_pack", "{}: the settings name no pack; name one with --pack",
                             request.config.string());
        }
        request.pack = settings->exhibit.packs.front();
    }
    TRY(const std::unique_ptr<display::Display> display, make_display(*settings, true));
    const scene::DevicePlan devices = scene::plan_devices(*settings, false, false);
    TRY(const PlanMeasurement measured,
        measure_plan(*settings, devices, request.pack, request.technique, *display));
    const PlanReport report{.config = request.config.string(),
                            .pack = request.pack.string(),
                            .technique = request.technique,
                            .devices = devices,
                            .measured = measured};
    fmt::print("{}", request.json ? plan_json(report) : plan_text(report));
    return {};
}

} // namespace

int plan_command(int argc, char** argv) {
    Request request;
    if (const std::optional<int> end = read_arguments(argc, argv, request)) {
        return *end;
    }
    return exit_status("frustumscreen", plan(request));
}

} // namespace frustumscreen::programs
