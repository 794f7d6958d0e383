#include "app/programs/frustumscreen/status/status_command.h"

#include "app/programs/common/command_line.h"
#include "app/programs/common/guarded_main.h"
#include "app/programs/frustumscreen/staff_service.h"
#include "app/programs/frustumscreen/status/status_places.h"
#include "app/status/exhibit_verdict.h"
#include "app/status/prometheus_text.h"
#include "app/status/status_document.h"
#include "app/status/status_lines.h"
#include "firmware_host/base/file.h"

#include <fmt/format.h>

#include <cstdio>
#include <ctime>
#include <filesystem>
#include <optional>
#include <string>

namespace frustumscreen::programs {

namespace {

struct Request {
    status::StatusPlaces places;
    std::filesystem::path staff_socket = usual_staff_socket;
    std::filesystem::path screenshot;
    bool json = false;
    bool prometheus = false;
};

std::optional<int> read_arguments(int argc, char** argv, Request& request) {
    CommandLine app("Prints the status of this machine's exhibit. Exit status: 0 the exhibit runs and all "
                    "its devices work; 1 something is wrong, or no status was found.",
                    "frustumscreen status");
    const CommandOption json = app.add_flag("--json", request.json, "print the whole status as JSON");
    app.add_flag("--prometheus", request.prometheus, "print figures in Prometheus' text format")
        .excludes(json);
    app.add_option("--screenshot", request.screenshot,
                   "write the picture that is projected now to this PNG file");
    add_status_places(app, request.places);
    app.add_option("--data-folder", request.places.data_folder, "a folder on the disk with the packs")
        .capture_default_str();
    app.add_option("--root", request.places.root, "folder that contains sys and proc; another one for tests")
        .capture_default_str();
    app.add_option("--staff-socket", request.staff_socket, "the exhibit's socket for screenshots")
        .capture_default_str();
    return app.end_of_arguments(argc, argv);
}

Result<void> write_screenshot(const Request& request) {
    TRY(const Bytes png, ask_for_screenshot(request.staff_socket));
    return write_file(request.screenshot, png);
}

} // namespace

int status_command(int argc, char** argv) {
    Request request;
    if (const std::optional<int> status = read_arguments(argc, argv, request)) {
        return *status;
    }
    const status::KnownExhibit known =
        status::read_known_exhibit(request.places, status::status_clock(request.places.root));
    const std::string text = request.json         ? status::status_document(known)
                             : request.prometheus ? status::prometheus_text(known)
                                                  : status::status_text(known, std::time(nullptr));
    fmt::print("{}", text);
    std::fflush(stdout);
    int status = status::verdict_of(known).well ? 0 : 1;
    if (!request.screenshot.empty()) {
        status |= exit_status("frustumscreen", write_screenshot(request));
    }
    return status;
}

} // namespace frustumscreen::programs
