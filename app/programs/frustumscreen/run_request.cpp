#include "app/programs/frustumscreen/run_request.h"

#include "app/programs/common/argument_checks.h"
#include "app/programs/common/command_line.h"

namespace frustumscreen::programs {

std::optional<int> read_run_arguments(int argc, const char* const* argv, RunRequest& request) {
    bool everything = false;
    CommandLine app("Runs the exhibit until SIGTERM, SIGINT or the end of --seconds.", "frustumscreen run");
    app.add_option("--config", request.places.config, "the kiosk's settings, TOML").required();
    app.add_flag("--headless", request.headless, "run without a screen");
    const CommandOption seconds = app.add_option("--seconds", request.seconds, "stop after this many seconds")
                                      .check(seconds_between(0.01, 1e6));
    app.add_option("--out", request.out,
                   "folder for pictures (frame_*.png, screen_*.png, poses.csv) and frames.csv of all frames; "
                   "created if missing")
        .needs(seconds);
    app.add_option("--stills", request.stills, "number of pictures in --out, spread over the run")
        .within(0, 64)
        .capture_default_str();
    app.add_option("--status-file", request.status_file, "JSON file to write the status to, once a second");
    app.add_option("--staff-socket", request.staff_socket,
                   "local socket for frustumscreen status --screenshot");
    app.add_option("--calibrate-file", request.calibrate_file,
                   "file to create when the staff ask for the calibration with the buttons; the service then "
                   "starts frustumscreen-calibrate table");
    app.add_option("--reset-file", request.reset_file,
                   "file to create when the staff confirm a reset to the state of delivery, which a signed "
                   "stick has requested; the service then resets the kiosk");
    app.add_option("--copy-file", request.copy_file,
                   "file to create when the staff confirm a copy of the kiosk onto a stick that waits for "
                   "it; the service then has it written");
    app.add_option("--mode-file", request.places.mode_file,
                   "file with the watchdog's mode: normal, last_good_set, plain or built_in");
    app.add_option("--shipped", request.places.shipped,
                   "folder of the built-in artifact and of the shipped settings")
        .capture_default_str();
    app.add_option("--cache", request.places.cache,
                   "folder for the last good settings, compiled shaders and crash records");
    app.add_option("--record", request.record,
                   "write the tracker's packets to a new file, for frustumscreen-poses convert");
    app.add_flag("--pattern", request.pattern, "show the alignment pattern instead of artifacts");
    app.add_option("--packs", request.show.packs, "packs to show instead of those in the settings");
    app.add_option("--technique", request.show.technique,
                   "quality level to draw: auto, finest, level0, level1, ..., relief, relief96, ..., "
                   "relief-gpu, relief96-gpu, ...")
        .check(is_technique_word())
        .capture_default_str();
    app.add_flag("--fast", request.fast,
                 "run as fast as the machine can, on a clock that steps by one frame");
    app.add_flag("--full-redraw", request.full_redraw,
                 "draw the whole picture in every frame, for measurements");
    app.add_option("--soak", request.changes,
                   "change the artifact this many times at equal intervals; the panel is ignored")
        .within(1, 1000000)
        .needs(seconds);
    app.add_flag("--everything", everything,
                 "also load what the scene does not need, for comparison; see frustumscreen plan");
    app.add_flag("--json", request.json, "print the report as JSON");
    const std::optional<int> end = app.end_of_arguments(argc, argv);
    request.show.cull_kinds = everything ? 0U : scene::AllCullKinds;
    return end;
}

} // namespace frustumscreen::programs
