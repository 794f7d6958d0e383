#include "app/programs/frustumscreen/run_command.h"

#include "app/programs/common/argument_checks.h"
#include "app/programs/common/command_line.h"
#include "app/programs/common/guarded_main.h"
#include "app/programs/devices/wiring.h"
#include "app/programs/frustumscreen/run_mode.h"
#include "app/programs/frustumscreen/staff_service.h"
#include "app/scene/device_plan.h"
#include "app/settings/settings.h"
#include "app/show/artifact_show.h"
#include "app/show/installed_show.h"
#include "app/show/library_watch.h"
#include "app/show/live_exhibit.h"
#include "app/show/pattern_show.h"
#include "app/show/run_loop.h"
#include "app/show/run_report.h"
#include "app/show/set_arrival.h"
#include "app/simulation/visitor_view.h"
#include "app/status/known_exhibit.h"
#include "firmware_host/base/file.h"
#include "firmware_host/base/format_sentence.h"
#include "firmware_host/base/local_time.h"
#include "firmware_host/base/standard_error.h"
#include "firmware_host/display/hotplug.h"
#include "firmware_host/service/crash_record.h"
#include "firmware_host/sound/silent_sound.h"
#include "firmware_host/sound/wav_sound.h"
#include "firmware_host/tracker/pose_file.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace frustumscreen {

namespace {

struct Request {
    RunPlaces places;
    std::filesystem::path out;
    std::filesystem::path status_file;
    std::filesystem::path staff_socket;
    std::filesystem::path calibrate_file;
    std::filesystem::path record;
    ArtifactShowOptions show;
    Trust trust = Trust::Newest; ///< in the installed sets
    double seconds = 0.0;        ///< 0 = until told to stop
    int stills = 8;
    int changes = 0;
    bool headless = false;
    bool fast = false;
    bool pattern = false;
    bool full_redraw = false;
    bool json = false;
};

std::optional<int> read_arguments(int argc, char** argv, Request& request) {
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
    request.show.economies = everything ? 0U : AllEconomies;
    return end;
}

/// The longest time from the loop's end to the program's: it does not wait for a device's thread that hangs.
constexpr Nanoseconds longest_stop = std::chrono::milliseconds(400);
constexpr Nanoseconds between_looks_for_card = std::chrono::seconds(1);
/// While the machine boots, udev may not have given the card to the exhibit's user yet.
constexpr Nanoseconds longest_boot = std::chrono::seconds(30);
/// A service shows for this long why it has nothing to show. Then it ends, is started again and looks for
/// packs again; at once when a set of packs is installed meanwhile.
constexpr Nanoseconds excuse_length = std::chrono::minutes(1);

Nanoseconds nanoseconds(double seconds) {
    return Nanoseconds(static_cast<Nanoseconds::rep>(std::llround(seconds * 1e9)));
}

/// A service waits for a graphics card whose driver comes late, and for a while for a card that cannot be
/// used yet; a person is told at once.
Result<std::unique_ptr<Display>> wait_for_display(const Request& request, const Settings& settings,
                                                  const StopSignals& stop_signals, ServiceManager& manager,
                                                  const Journal& journal) {
    std::unique_ptr<Hotplug> hotplug; // once there is something to wait for
    Sentence noted;
    const MonotonicTime begin = monotonic_now();
    while (true) {
        Result<std::unique_ptr<Display>> display = make_display(settings, request.headless);
        if (display || !manager.listens()) {
            return display;
        }
        const bool may_come = display.error().kind == ErrorKind::DeviceLost;
        if (!may_come && monotonic_now() - begin >= longest_boot) {
            return display;
        }
        if (!hotplug) {
            hotplug = make_udev_hotplug();
        }
        const Sentence why(display.error().message);
        if (why != noted) {
            noted = why;
            journal.note(LogPriority::Warning, why.view(), {{"DEVICE", "display"}});
        }
        manager.status(why);
        manager.still_starting(10 * between_looks_for_card);
        const StopSignals::AtOnce at_once(stop_signals); // nothing to close yet
        static_cast<void>(hotplug->wait(between_looks_for_card));
    }
}

Result<std::unique_ptr<Show>> make_show(const Request& request, const Settings& settings,
                                        const DevicePlan& devices, const Display& display,
                                        MonotonicTime start) {
    if (request.pattern) {
        return PatternShow::create(settings);
    }
    ArtifactShowOptions options = request.show;
    options.waits = request.fast;
    const bool from_library = options.packs.empty();
    if (from_library) {
        options.packs = settings.exhibit.packs;
        options.packs_key = settings.exhibit.packs_key;
    }
    // Other sets come in real time alone: a run of simulated time is repeatable.
    const bool watches = from_library && !request.fast && library_is_there(settings);
    options.other_sets = watches;
    const auto create = [&](const ArtifactShowOptions& each) {
        return ArtifactShow::create(settings, devices, each, {display.framebuffer(), 0});
    };
    InstalledShow installed;
    if (from_library) {
        installed = show_installed_set(settings, options, request.trust, create);
    }
    Result<std::unique_ptr<ArtifactShow>> artifacts =
        installed.show ? std::move(installed.show) : create(options);
    if (!artifacts) {
        return tl::unexpected<Error>(artifacts.error());
    }
    for (const std::string& note : (*artifacts)->notes()) {
        say_line("frustumscreen", note);
    }
    Exhibit exhibit = make_exhibit(settings, **artifacts, start);
    ArtifactShow& stage = **artifacts;
    auto live = std::make_unique<LiveExhibit>(
        settings, std::move(*artifacts), std::move(exhibit), display.name(),
        request.fast ? PromptReader::Answer::Always : PromptReader::Answer::WhenReady);
    if (watches) {
        live->watch(stage,
                    std::make_unique<LibraryWatch>(
                        settings, LibraryWatch::SetUp{settings.exhibit.library, stage.set_options(),
                                                      stage.expected_frames(), std::move(installed.start),
                                                      stage.set().number}));
    }
    return live;
}

/// A service that cannot record says so, and the exhibit goes on without the recording.
Result<Inputs> open_inputs(const Request& request, const Settings& settings, const DevicePlan& devices,
                           bool is_service, std::optional<Nanoseconds> press_every, MonotonicTime start) {
    std::unique_ptr<PacketRecorder> recorder;
    Sentence why_not;
    if (!request.record.empty()) {
        Result<std::unique_ptr<PacketRecorder>> made = make_recorder(devices.tracker, request.record);
        if (made) {
            recorder = std::move(*made);
        } else if (is_service) {
            why_not = format_sentence("nothing is recorded: {}", made.error().message);
        } else {
            return tl::unexpected<Error>(made.error());
        }
    }
    Result<Inputs> inputs = make_inputs(settings, devices, press_every, start, std::move(recorder));
    if (inputs) {
        inputs->why_not_recorded = why_not;
    }
    return inputs;
}

/// Without a screen there is no loudspeaker either: what would be heard is kept with the pictures.
std::unique_ptr<Sound> open_sound(const Request& request, const Settings& settings, MonotonicTime start) {
    if (!request.headless || settings.sound.kind == SoundKind::None) {
        return make_sound(settings.sound);
    }
    if (request.out.empty()) {
        return std::make_unique<SilentSound>(start);
    }
    return std::make_unique<WavSound>(start);
}

/// Shows the error on the table for the staff, since nobody reads a service's standard error.
Result<std::unique_ptr<Show>> make_excuse(const Settings& settings, const Journal& journal,
                                          const Error& why) {
    journal.note(LogPriority::Error, why.message, {{"DEVICE", "exhibit"}});
    Result<std::unique_ptr<PatternShow>> pattern = PatternShow::create(settings);
    if (!pattern) {
        return tl::unexpected<Error>(why);
    }
    (*pattern)->set_lines({why.message});
    (*pattern)->is_fault();
    return std::move(*pattern);
}

/// frame_00000.png ..., poses.csv with their poses, frames.csv with every frame of the run.
Result<void> write_pictures(const std::filesystem::path& folder, const LoopResult& result) {
    std::vector<PoseSample> poses;
    for (std::size_t k = 0; k < result.stills.size(); ++k) {
        const Still& still = result.stills[k];
        const RigidTransform& pose = still.situation.table_from_prop;
        poses.push_back({still.time, prop_station, pose.translation, pose.rotation, true});
        poses.push_back({still.time, head_station, still.situation.eye_m, {1.0, 0.0, 0.0, 0.0}, true});
        const std::filesystem::path file = folder / fmt::format("frame_{:05}.png", k);
        if (Result<void> written = write_file(file, encode_png(still.picture)); !written) {
            return written;
        }
    }
    if (Result<void> written = write_file(folder / "poses.csv", as_bytes(write_poses(poses))); !written) {
        return written;
    }
    return write_file(folder / "frames.csv", as_bytes(frames_csv(result.rows)));
}

void report(const Request& request, const LoopResult& result) {
    RunStatus status = result.status;
    stamp(status);
    if (request.json) {
        fmt::print("{}", status_json(status));
        return;
    }
    fmt::print(
        "{} frames in {:.1f} s, {} drawn: median {:.2f} ms, 95th percentile {:.2f} ms, 99th {:.2f} ms; {} "
        "deadlines and {} display times missed, {} changes of level; {:.0f} MiB resident",
        status.frames, status.uptime_s, status.drawn, status.median_ms, status.p95_ms, status.p99_ms,
        status.missed_deadlines, status.late, status.level_switches, status.resident_mib);
    if (request.changes > 0) {
        fmt::print("; {} changes of artifact, {:+.1f} MiB since the first tenth, p99/p50 {:.2f}",
                   request.changes, status.resident_mib - result.first_resident_mib,
                   status.median_ms > 0.0 ? status.p99_ms / status.median_ms : 0.0);
    }
    fmt::print("\n");
    if (!request.out.empty()) {
        fmt::print("{} pictures in {}\n", result.stills.size(), request.out.string());
    }
}

/// A calibration needs a tracker whose reports it takes, and buttons.
bool may_calibrate(const Request& request, const Settings& settings, const DevicePlan& devices) {
    return !request.calibrate_file.empty() && settings.calibration.by_buttons &&
           devices.tracker != TrackerKind::None && devices.panel;
}

void ask_for_calibration(const std::filesystem::path& file, const Journal& journal) {
    const Result<void> written = write_file(file, {});
    journal.note(
        LogPriority::Notice,
        written ? "the staff ask for the table's calibration"
                : fmt::format("the table's calibration cannot be asked for: {}", written.error().message),
        {{"DEVICE", "calibration"}});
}

/// Says the error before anything is closed: a thread that hangs may hold that up until the process ends.
int end_with(const Error& why) {
    const int status = exit_status("frustumscreen", tl::unexpected<Error>(why));
    end_within(longest_stop, status);
    return status;
}

void record_crashes_of(const RunPlaces& places) {
    const SystemImage image = read_system_image(usual_boot_folder);
    const std::string system =
        image.there() ? fmt::format("{}, image {}", system_name(), image.version) : system_name();
    record_crashes({places.cache.empty() ? std::filesystem::path() : places.cache / "crashes",
                    FRUSTUMSCREEN_VERSION, system});
}

/// The exit status, or an error that is still to be said.
Result<int> run(Request& request) {
    record_crashes_of(request.places);
    const StopSignals stop_signals;
    const Journal journal("frustumscreen");
    ServiceManager manager;
    const Result<RunMode> mode = choose_run_mode(request.places, journal);
    if (!mode) {
        return tl::unexpected<Error>(mode.error());
    }
    const CheckedSettings* settings = &mode->used.settings;
    if (!mode->packs.empty()) {
        request.show.packs = mode->packs;
    }
    request.trust = mode->mode == Mode::LastGoodSet ? Trust::Before : Trust::Newest;
    static_cast<void>(use_time_zone((*settings)->hours.time_zone)); // before there is a second thread
    if (!request.out.empty()) {
        std::error_code failed;
        std::filesystem::create_directories(request.out, failed);
        if (failed) {
            return bad_input(
                fmt::format("{}: the folder cannot be made: {}", request.out.string(), failed.message()));
        }
    }
    if (const std::filesystem::path folder = request.status_file.parent_path();
        !folder.empty() && !std::filesystem::is_directory(folder)) {
        return bad_input(fmt::format("{}: the folder of --status-file is not there", folder.string()));
    }
    prepare_driver(request.places, mode->mode, journal);
    const Result<std::unique_ptr<Display>> display =
        wait_for_display(request, **settings, stop_signals, manager, journal);
    if (!display) {
        return tl::unexpected<Error>(display.error());
    }
    note_driver_for_crashes((*display)->name());
    // Simulated time starts at zero, real time when everything is loaded.
    const auto now = [&request] { return request.fast ? MonotonicTime{} : monotonic_now(); };
    const DevicePlan devices = plan_devices(**settings, request.changes > 0, !request.status_file.empty());
    const std::filesystem::path& library = (*settings)->exhibit.library;
    const std::optional<FileStamp> set_before = stamp_of_set(library);
    Result<std::unique_ptr<Show>> show = [&] {
        const StopSignals::AtOnce at_once(stop_signals); // loading takes long and leaves nothing behind
        return make_show(request, **settings, devices, **display, now());
    }();
    std::optional<Error> excuse;
    std::optional<SetArrival> arrival;
    if (!show && manager.listens()) {
        excuse = show.error();
        show = make_excuse(**settings, journal, *excuse);
        if (!library.empty()) {
            arrival.emplace(library, set_before);
        }
    }
    if (!show) {
        return tl::unexpected<Error>(show.error());
    }
    std::optional<Nanoseconds> press_every;
    if (request.changes > 0) {
        press_every = nanoseconds(request.seconds / request.changes);
    }
    const MonotonicTime start = now();
    Result<Inputs> inputs = open_inputs(request, **settings, devices, manager.listens(), press_every, start);
    if (!inputs) {
        return tl::unexpected<Error>(inputs.error());
    }
    if ((*show)->speaks()) {
        inputs->sound = open_sound(request, **settings, start);
    }
    LoopOptions options;
    if (request.seconds > 0.0) {
        options.length = nanoseconds(request.seconds);
    } else if (excuse) {
        options.length = excuse_length;
    }
    options.fast = request.fast;
    options.redraw = request.full_redraw ? Redraw::Everything : Redraw::Changes;
    options.stills = request.out.empty() ? 0 : request.stills;
    options.keep_rows = !request.out.empty();
    options.stop = &stop_signals;
    if (arrival) {
        options.ends = [&] { return arrival->came(); };
    }
    Screenshot screenshot((*display)->width(), (*display)->height());
    options.screenshot = request.staff_socket.empty() ? nullptr : &screenshot;
    const std::unique_ptr<StaffSocket> staff = open_staff_socket(request.staff_socket, screenshot, journal);
    const std::string& zone = (*settings)->hours.time_zone;
    RunHours hours((*settings)->hours, local_offset_at, has_time_zone(zone) ? std::string_view() : zone);
    options.hours = &hours;
    if (may_calibrate(request, **settings, devices)) {
        options.calibrate = [&] { ask_for_calibration(request.calibrate_file, journal); };
    }
    options.mode = word_of(mode->mode);
    options.settings = Sentence(mode->used.instead);
    StatusFile status_file(request.status_file, keeper_of(request.places, *mode));
    RunWatch watch(manager, journal);
    const Result<LoopResult> result =
        run_loop(**settings, **display, *inputs, **show, options, status_file, watch, start);
    manager.stopping();
    if (result && arrival && arrival->came()) {
        journal.note(LogPriority::Notice, "a set of packs was installed; the exhibit starts anew with it",
                     {{"DEVICE", "set"}});
        end_within(longest_stop);
        return 0;
    }
    const bool excused = excuse && result && result->status.uptime_s >= to_seconds(excuse_length);
    if (!result || excused) { // not told to stop
        const Error& why = result ? *excuse : result.error();
        return request.seconds == 0.0 ? Result<int>(end_with(why)) : tl::unexpected<Error>(why);
    }
    if (request.seconds == 0.0) {
        end_within(longest_stop);
    }
    if (!request.out.empty()) {
        std::error_code failed;
        std::filesystem::remove(request.out / visitor_cameras_name, failed); // of an earlier call of render
        if (Result<void> written = write_pictures(request.out, *result); !written) {
            return tl::unexpected<Error>(written.error());
        }
        if (const auto* heard = dynamic_cast<const WavSound*>(inputs->sound.get())) {
            if (Result<void> written = heard->write(request.out / "sound.wav"); !written) {
                return tl::unexpected<Error>(written.error());
            }
        }
    }
    report(request, *result);
    return 0;
}

} // namespace

int run_command(int argc, char** argv) {
    Request request;
    if (const std::optional<int> end = read_arguments(argc, argv, request)) {
        return *end;
    }
    const Result<int> status = run(request);
    return status ? *status : exit_status("frustumscreen", tl::unexpected<Error>(status.error()));
}

} // namespace frustumscreen
