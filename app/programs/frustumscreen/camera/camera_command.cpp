#include "app/programs/frustumscreen/camera/camera_command.h"

#include "app/programs/common/argument_checks.h"
#include "app/programs/common/command_line.h"
#include "app/programs/common/guarded_main.h"
#include "app/programs/common/progress_line.h"
#include "app/programs/devices/wiring.h"
#include "app/programs/frustumscreen/camera/camera_report.h"
#include "firmware_host/service/stop_signals.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <thread>

namespace frustumscreen::programs {

namespace {

constexpr Nanoseconds between_polls = std::chrono::milliseconds(5);
constexpr double usual_s = 5.0;
constexpr double longest_s = 86400.0;
/// Longest time from the report to the program's end, because a thread may hang in its device.
constexpr Nanoseconds longest_stop = std::chrono::milliseconds(450);

struct Request {
    std::filesystem::path config;
    double seconds = usual_s;
    bool json = false;
    bool is_on = false;
};

std::optional<int> read_arguments(int argc, char** argv, Request& request) {
    CommandLine app("Lists the cameras, and checks the one in the settings and its frames. No picture is "
                    "kept. Exit status: 0 the camera works or the settings have none; 1 it does not work.",
                    "frustumscreen camera");
    app.add_option("--config", request.config, "the kiosk's settings, TOML").required();
    app.add_option("--seconds", request.seconds, "time to watch the camera, seconds")
        .check(seconds_between(0.01, longest_s))
        .capture_default_str();
    const CommandOption json = app.add_flag("--json", request.json, "print the findings as JSON");
    app.add_flag("--is-on", request.is_on,
                 "only test whether the settings have a camera, by the exit status; nothing is opened")
        .excludes(json);
    return app.end_of_arguments(argc, argv);
}

/// Takes the camera's frames until the time is over or a stop is requested; prints each new state to standard error.
void look(camera::Camera& camera, const Request& request, const service::StopSignals& stop,
          CameraReport& report) {
    ProgressLine progress("watched seconds");
    camera::CameraFrame frame;
    MonotonicTime now = report.begun;
    report.state = camera.state();
    report.changes.push_back({now, report.state});
    for (; to_seconds(now - report.begun) < request.seconds && !stop.received(); now = monotonic_now()) {
        if (camera.poll(frame)) {
            report.last_look = camera::look_at(frame.luma);
        }
        if (const camera::CameraState state = camera.state(); state != report.state) {
            report.state = state;
            report.changes.push_back({now, state});
            fmt::print(stderr, "frustumscreen: {}\n", camera::sentence_of(state));
        }
        progress.show(static_cast<std::size_t>(to_seconds(now - report.begun)),
                      static_cast<std::size_t>(std::ceil(request.seconds)));
        std::this_thread::sleep_for(between_polls);
    }
    report.seconds = to_seconds(now - report.begun);
    report.set_up = camera.set_up();
    report.counts = camera.counts();
    report.rate_hz = camera.rate_hz();
}

/// `camera` is the caller's to close, because its thread may hang in the device.
Result<int> run(const Request& request, std::unique_ptr<camera::Camera>& camera) {
    const service::StopSignals stop;
    TRY(const settings::CheckedSettings settings, settings::load_settings(request.config));
    const settings::CameraSettings& requested = settings->camera;
    CameraReport report;
    report.is_on = requested.kind == settings::CameraKind::V4l2;
    if (request.is_on) {
        return report.is_on ? 0 : 1;
    }
    report.found = camera::list_cameras(*camera::kernel_v4l2_devices(), camera_request(requested));
    report.begun = monotonic_now();
    if (report.is_on) {
        camera = make_camera(requested);
        look(*camera, request, stop, report);
    }
    const std::string text = request.json ? camera_json(report) : camera_text(report, requested);
    fmt::print("{}", text);
    return report.is_on && camera::health_of(report.state) != camera::CameraHealth::Well ? 1 : 0;
}

} // namespace

int camera_command(int argc, char** argv) {
    Request request;
    if (const std::optional<int> end = read_arguments(argc, argv, request)) {
        return *end;
    }
    std::unique_ptr<camera::Camera> camera;
    const Result<int> ran = run(request, camera);
    const int status = ran ? *ran : exit_status("frustumscreen", tl::unexpected<Error>(ran.error()));
    std::fflush(stdout);
    service::end_within(longest_stop, status);
    return status;
}

} // namespace frustumscreen::programs
