#include "app/programs/frustumscreen/run_request.h"

#include "app/programs/common/argument_checks.h"
#include "app/programs/common/command_line.h"

namespace frustumscreen {

std::optional<int> read_run_arguments(int argc, const char* const* argv, RunRequest& request) {
    bool everything = false;
    CommandLine app("Runs the exhibit until SIGTERM or SIGINT, or for some seconds.", "frustumscreen run");
    app.add_option("--config", request.places.config, "the kiosk's settings, TOML").required();
    app.add_flag("--headless", request.headless, "without a screen");
    const CommandOption seconds = app.add_option("--seconds", request.seconds, "stop after so many seconds")
                                      .check(seconds_between(0.01, 1e6));
    app.add_option("--out", request.out,
                   "folder for frame_*.png, their poses.csv and frames.csv of all frames; made if missing")
        .needs(seconds);
    app.add_option("--stills", request.stills, "how many pictures --out keeps, spread over the run")
        .within(0, 64)
        .capture_default_str();
    app.add_option("--status-file", request.status_file, "JSON, renewed every second");
    app.add_option("--staff-socket", request.staff_socket,
                   "a local socket on which the staff ask for the picture; see frustumscreen status");
    app.add_option("--calibrate-file", request.calibrate_file,
                   "made when the staff ask for the table's calibration with the buttons; who looks at it "
                   "ends the exhibit and starts frustumscreen-calibrate table");
    app.add_option("--reset-file", request.reset_file,
                   "made when the staff confirm with the buttons that the kiosk goes back to the state of "
                   "delivery, for which a signed stick has asked; who looks at it does the rest");
    app.add_option("--mode-file", request.places.mode_file,
                   "what is to be shown: normal, last_good_set, plain or built_in; the watchdog's");
    app.add_option("--shipped", request.places.shipped,
                   "folder of the built-in artifact and of the settings as shipped")
        .capture_default_str();
    app.add_option("--cache", request.places.cache,
                   "folder for a copy of the last good settings, compiled shaders and the last crashes");
    app.add_option("--record", request.record,
                   "keep the tracker's packets in a new file; frustumscreen-poses convert makes poses of it");
    app.add_flag("--pattern", request.pattern, "the alignment test picture instead of artifacts");
    app.add_option("--packs", request.show.packs, "artifacts to show instead of those in the settings");
    app.add_option("--technique", request.show.technique,
                   "auto, finest, level0, level1, ..., relief, relief96, ..., relief-gpu, relief96-gpu, ...")
        .check(is_technique_word())
        .capture_default_str();
    app.add_flag("--fast", request.fast, "as fast as the machine can, on a clock that steps by one frame");
    app.add_flag("--full-redraw", request.full_redraw, "draw the whole picture every time, for measuring");
    app.add_option("--soak", request.changes,
                   "change the artifact so many times, evenly, instead of the panel")
        .within(1, 1000000)
        .needs(seconds);
    app.add_flag("--everything", everything,
                 "load also what this scene does not need, to compare; see frustumscreen plan");
    app.add_flag("--json", request.json, "report as JSON");
    const std::optional<int> end = app.end_of_arguments(argc, argv);
    request.show.cull_kinds = everything ? 0U : AllCullKinds;
    return end;
}

} // namespace frustumscreen
