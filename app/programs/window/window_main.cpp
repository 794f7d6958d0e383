/// frustumscreen-window: the exhibit in a window on a developer's desktop, with the mouse for the prop.
#include "app/geometry/table_plane.h"
#include "app/programs/common/argument_checks.h"
#include "app/programs/common/command_line.h"
#include "app/programs/common/guarded_main.h"
#include "app/programs/window/help_picture.h"
#include "app/programs/window/visitor_half.h"
#include "app/scene/device_plan.h"
#include "app/scene/scene_plan.h"
#include "app/settings/settings.h"
#include "app/show/artifact_show.h"
#include "app/show/live_exhibit.h"
#include "app/show/pattern_show.h"
#include "app/show/run_loop.h"
#include "firmware_host/base/standard_error.h"
#include "firmware_host/base/version.h"
#include "firmware_host/service/journal.h"
#include "firmware_host/service/service_manager.h"
#include "firmware_host/service/stop_signals.h"
#include "firmware_host/window/sdl_window.h"

#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <optional>
#include <utility>

namespace frustumscreen::programs {
namespace {

struct Request {
    std::filesystem::path config;
    show::ArtifactShowOptions show;
    double seconds = 0.0; ///< 0: until the window is closed
    bool pattern = false;
};

std::optional<int> read_arguments(int argc, char** argv, Request& request) {
    CommandLine app("Runs the exhibit in a window: the projector's picture on the left, the visitor's view "
                    "on the right. Drag: slide the prop; wheel or right drag: turn it; middle drag: move the "
                    "eye; 1 to 7: the buttons; H: help; Esc: end.",
                    "frustumscreen-window");
    app.set_version_flag("--version", name_and_version("frustumscreen-window"));
    app.add_option("--config", request.config, "the kiosk's settings, TOML").required();
    app.add_option("--packs", request.show.packs, "packs to show instead of those in the settings");
    app.add_option("--technique", request.show.technique,
                   "quality level to draw: auto, finest, level0, level1, ..., relief, relief96, ..., "
                   "relief-gpu, relief96-gpu, ...")
        .check(is_technique_word())
        .capture_default_str();
    app.add_flag("--pattern", request.pattern, "show the alignment pattern instead of artifacts");
    app.add_option("--seconds", request.seconds, "stop after this many seconds")
        .check(seconds_between(0.01, 1e6));
    return app.end_of_arguments(argc, argv);
}

/// Maps a pixel of the projector's picture to the table.
window::TableFromPicture table_from_picture(const settings::ProjectorSettings& projector) {
    return [projector](const glm::dvec2& pixel) {
        return geometry::lights_table(projector.pinhole, projector.table_from_projector, pixel);
    };
}

Result<std::unique_ptr<show::Show>> make_show(const Request& request, const settings::Settings& settings,
                                              const display::Display& display) {
    if (request.pattern) {
        return show::PatternShow::create(settings);
    }
    show::ArtifactShowOptions options = request.show;
    options.program = "frustumscreen-window";
    if (options.packs.empty()) {
        options.packs = settings.exhibit.packs;
        options.packs_key = settings.exhibit.packs_key;
    }
    scene::DevicePlan devices;
    devices.tracker = settings::TrackerKind::Simulated;
    devices.panel = devices.other_packs = devices.language = true;
    TRY(std::unique_ptr<show::ArtifactShow> show,
        show::ArtifactShow::create(settings, devices, options, {display.framebuffer(), 0}));
    for (const std::string& note : show->notes()) {
        say_line(options.program, note);
    }
    exhibit::Exhibit exhibit = show::make_exhibit(settings, *show, monotonic_now());
    return std::make_unique<show::LiveExhibit>(settings, std::move(show), std::move(exhibit), display.name());
}

/// `visitor` must outlive the window.
window::WindowSetUp set_up_of(const settings::Settings& settings, const VisitorHalf& visitor,
                              window::WindowHelp help) {
    const glm::dvec2 table(settings.table.width_m, settings.table.depth_m);
    window::WindowSetUp set_up;
    set_up.width = settings.projector.pinhole.width;
    set_up.height = settings.projector.pinhole.height;
    set_up.half_extent_m = 0.5 * (table - settings.prop.base_m);
    set_up.eye_m = settings.eye.default_m;
    set_up.table_from_picture = table_from_picture(settings.projector);
    set_up.table_from_view = [&visitor](const glm::dvec2& pixel, const glm::dvec3& eye_m, PixelSize half) {
        return visitor.on_table(pixel, eye_m, half);
    };
    set_up.see = [&visitor](const tracker::PoseSample& prop, const glm::dvec3& eye_m, PixelSize half,
                            window::SeenSurfaces& seen) { visitor.see(prop, eye_m, half, seen); };
    set_up.help = std::move(help);
    return set_up;
}

Result<void> run(const Request& request) {
    const service::StopSignals stop_signals;
    const service::Journal journal("frustumscreen-window");
    service::ServiceManager manager;
    TRY(const settings::CheckedSettings checked, settings::load_settings(request.config));
    settings::Settings settings = *checked;
    // The mouse moves the prop anywhere on the table, like a hand.
    settings.tracker.kind = settings::TrackerKind::Simulated;
    settings.tracker.display_latency_ms = 0.0;
    settings.eye.tracked = true;
    settings.projector.stereo = settings::OutputStereo::Off; // the visitor's half shows what one eye sees
    TRY(window::WindowHelp help, help_picture());
    const VisitorHalf visitor(settings);
    TRY(window::Window window, window::open_window(set_up_of(settings, visitor, std::move(help))));
    const Result<std::unique_ptr<show::Show>> show = [&] {
        const service::StopSignals::AtOnce at_once(stop_signals);
        return make_show(request, settings, *window.display);
    }();
    TRY_VOID(show);
    show::Inputs inputs;
    inputs.tracker =
        std::make_unique<tracking::RegisteredTracker>(std::move(window.tracker), geometry::Registration{});
    inputs.panel = std::move(window.panel);
    show::LoopOptions options;
    if (request.seconds > 0.0) {
        options.length = Nanoseconds(static_cast<Nanoseconds::rep>(std::llround(request.seconds * 1e9)));
    }
    options.stop = &stop_signals;
    show::StatusFile status_file{{.status_file = {}}};
    show::RunWatch watch(manager, journal);
    return without_value(show::run_loop(settings, *window.display, inputs, **show, options, status_file,
                                        watch, monotonic_now()));
}

int window_main(int argc, char** argv) {
    Request request;
    if (const std::optional<int> end = read_arguments(argc, argv, request)) {
        return *end;
    }
    return exit_status("frustumscreen-window", run(request));
}

} // namespace
} // namespace frustumscreen::programs

int main(int argc, char** argv) {
    return frustumscreen::programs::guarded_main("frustumscreen-window", frustumscreen::programs::window_main,
                                                 argc, argv);
}
