#include "app/programs/frustumscreen/run_command.h"

#include "app/programs/common/guarded_main.h"
#include "app/programs/devices/wiring.h"
#include "app/programs/frustumscreen/run_end.h"
#include "app/programs/frustumscreen/run_mode.h"
#include "app/programs/frustumscreen/run_output.h"
#include "app/programs/frustumscreen/run_request.h"
#include "app/programs/frustumscreen/run_show.h"
#include "app/programs/frustumscreen/staff_service.h"
#include "app/programs/frustumscreen/wait_for_display.h"
#include "app/scene/device_plan.h"
#include "app/scene/stereo.h"
#include "app/settings/settings.h"
#include "app/show/run_loop.h"
#include "app/show/run_report.h"
#include "app/show/screen_output.h"
#include "app/show/set_arrival.h"
#include "app/status/known_exhibit.h"
#include "firmware_host/base/file.h"
#include "firmware_host/base/format_sentence.h"
#include "firmware_host/base/local_time.h"
#include "firmware_host/base/version.h"
#include "firmware_host/service/crash_record.h"
#include "firmware_host/sound/silent_sound.h"
#include "firmware_host/sound/wav_sound.h"

#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>

namespace frustumscreen::programs {

namespace {

/// Longest time from the loop's end to the program's; a device's thread that hangs is not waited for.
constexpr Nanoseconds longest_stop = std::chrono::milliseconds(400);

Nanoseconds nanoseconds(double seconds) {
    return Nanoseconds(static_cast<Nanoseconds::rep>(std::llround(seconds * 1e9)));
}

void record_crashes_of(const RunPlaces& places) {
    const status::SystemImage image = status::read_system_image(status::usual_boot_folder);
    const std::string system = image.there()
                                   ? fmt::format("{}, image {}", status::system_name(), image.version)
                                   : status::system_name();
    service::record_crashes({places.cache.empty() ? std::filesystem::path() : places.cache / "crashes",
                             project_version(), system});
}

/// Reads the settings and packs of the watchdog's mode, and makes the folders for the run's output.
Result<RunMode> load(RunRequest& request, const service::Journal& journal) {
    TRY(RunMode mode, choose_run_mode(request.places, journal));
    if (!mode.packs.empty()) {
        request.show.packs = mode.packs;
    }
    request.trust = mode.mode == watch::Mode::LastGoodSet ? show::Trust::Before : show::Trust::Newest;
    if (!request.out.empty()) {
        std::error_code failed;
        std::filesystem::create_directories(request.out, failed);
        if (failed) {
            return bad_input("run.no_folder", "{}: the folder cannot be made: {}", request.out.string(),
                             failed.message());
        }
    }
    if (const std::filesystem::path folder = request.status_file.parent_path();
        !folder.empty() && !std::filesystem::is_directory(folder)) {
        return bad_input("run.no_status_folder",
                         "{}: the folder of --status-file is not there; make it first", folder.string());
    }
    return mode;
}

/// A service that cannot record reports it and runs without the recording.
Result<show::Inputs> open_inputs(const RunRequest& request, const settings::Settings& settings,
                                 const scene::DevicePlan& devices, bool is_service,
                                 std::optional<Nanoseconds> press_every, MonotonicTime start) {
    std::unique_ptr<tracker::PacketRecorder> recorder;
    Sentence why_not;
    if (!request.record.empty()) {
        Result<std::unique_ptr<tracker::PacketRecorder>> made =
            make_recorder(devices.tracker, request.record);
        if (made) {
            recorder = std::move(*made);
        } else if (is_service) {
            why_not = format_sentence("nothing is recorded: {}", made.error().message);
        } else {
            return tl::unexpected<Error>(made.error());
        }
    }
    Result<show::Inputs> inputs = make_inputs(settings, devices, press_every, start, std::move(recorder));
    if (inputs) {
        inputs->why_not_recorded = why_not;
    }
    return inputs;
}

/// A headless run has no loudspeaker: its sound is kept with the pictures.
std::unique_ptr<sound::Sound> open_sound(const RunRequest& request, const settings::Settings& settings,
                                         MonotonicTime start) {
    if (!request.headless || settings.sound.kind == settings::SoundKind::None) {
        return make_sound(settings.sound);
    }
    if (request.out.empty()) {
        return std::make_unique<sound::SilentSound>(start);
    }
    return std::make_unique<sound::WavSound>(start);
}

/// The open parts of a run, closed from the last to the first.
struct OpenExhibit {
    std::unique_ptr<display::Display> display;
    scene::DevicePlan devices;
    std::unique_ptr<show::Show> show;
    std::optional<Error> error_screen;         ///< why there is nothing to show; shown instead
    std::unique_ptr<show::SetArrival> arrival; ///< none: no set of packs can end the error screen
    MonotonicTime start;
    show::Inputs inputs;
    std::unique_ptr<show::ScreenOutput> screen; ///< none: the settings have no screen
};

/// Null if the settings have no screen; beside the alignment pattern none is opened either. The status reports a
/// screen that cannot be opened; the projector does not wait for it.
std::unique_ptr<show::ScreenOutput> open_screen(const RunRequest& request, const settings::Settings& settings,
                                                display::Display& projector, MonotonicTime start) {
    if (!settings.screen.exists() || request.pattern) {
        return nullptr;
    }
    return std::make_unique<show::ScreenOutput>(
        settings,
        show::ScreenParts{[&settings, &projector] { return make_screen(settings, projector); },
                          show::room_of(settings, !request.fast)},
        projector, start);
}

Result<OpenExhibit> open(const RunRequest& request, const settings::Settings& settings,
                         const service::StopSignals& stop_signals, service::ServiceManager& manager,
                         const service::Journal& journal) {
    OpenExhibit exhibit;
    TRY(exhibit.display, wait_for_display({[&] { return make_display(settings, request.headless); }},
                                          stop_signals, manager, journal));
    service::note_driver_for_crashes(exhibit.display->name());
    // Simulated time starts at zero, real time when loading is complete.
    const auto now = [&request] { return request.fast ? MonotonicTime{} : monotonic_now(); };
    exhibit.devices = scene::plan_devices(settings, request.changes > 0, !request.status_file.empty());
    const std::filesystem::path& library = settings.exhibit.library;
    const std::optional<show::FileStamp> set_before = show::stamp_of_set(library);
    const MonotonicTime begin =
        now(); // start of the room's time: a taken object glides from where the screen shows it
    Result<std::unique_ptr<show::Show>> show = [&] {
        const service::StopSignals::AtOnce at_once(
            stop_signals); // loading takes long and leaves nothing behind
        return make_show(request, settings, exhibit.devices, *exhibit.display, begin);
    }();
    if (!show && manager.listens()) {
        exhibit.error_screen = show.error();
        show = make_error_screen(settings, journal, *exhibit.error_screen);
        if (!library.empty()) {
            exhibit.arrival = std::make_unique<show::SetArrival>(library, set_before);
        }
    }
    TRY_VOID(show);
    exhibit.show = std::move(*show);
    exhibit.screen = open_screen(request, settings, *exhibit.display, begin);
    std::optional<Nanoseconds> press_every;
    if (request.changes > 0) {
        press_every = nanoseconds(request.seconds / request.changes);
    }
    exhibit.start = now();
    TRY(exhibit.inputs,
        open_inputs(request, settings, exhibit.devices, manager.listens(), press_every, exhibit.start));
    if (exhibit.show->speaks()) {
        exhibit.inputs.sound = open_sound(request, settings, exhibit.start);
    }
    return exhibit;
}

/// True if calibration by buttons is possible: it needs a tracker that reports poses, buttons, and a picture in the
/// projector's own pixels.
bool may_calibrate(const RunRequest& request, const settings::Settings& settings,
                   const scene::DevicePlan& devices) {
    return !request.calibrate_file.empty() && settings.calibration.by_buttons &&
           devices.tracker != settings::TrackerKind::None && devices.panel &&
           scene::keeps_pixels(settings::stereo_of(settings));
}

/// `what`: the table's calibration. `device`: for the journal.
void ask_for(std::string_view what, std::string_view device, const std::filesystem::path& file,
             const service::Journal& journal) {
    const Result<void> written = write_file(file, {});
    journal.note(service::LogPriority::Notice,
                 written ? fmt::format("the staff ask for {}", what)
                         : fmt::format("{} cannot be asked for: {}", what, written.error().message),
                 {{"DEVICE", std::string(device)}});
}

show::LoopOptions loop_options(const RunRequest& request, const RunMode& mode, const OpenExhibit& exhibit,
                               const service::Journal& journal) {
    show::LoopOptions options;
    if (request.seconds > 0.0) {
        options.length = nanoseconds(request.seconds);
    } else if (exhibit.error_screen) {
        options.length = error_screen_length;
    }
    options.fast = request.fast;
    options.redraw = request.full_redraw ? render::Redraw::Everything : render::Redraw::Changes;
    options.stills = request.out.empty() ? 0 : request.stills;
    options.keep_rows = !request.out.empty();
    if (exhibit.arrival) {
        options.ends = [&arrival = *exhibit.arrival] { return arrival.came(); };
    }
    if (may_calibrate(request, *mode.used.settings, exhibit.devices)) {
        options.calibrate = [&file = request.calibrate_file, &journal] {
            ask_for("the table's calibration", "calibration", file, journal);
        };
    }
    if (!request.reset_file.empty()) {
        options.reset = [&file = request.reset_file, &journal] {
            ask_for("the state of delivery", "stick", file, journal);
        };
    }
    if (!request.copy_file.empty()) {
        options.copy = [&file = request.copy_file, &journal] {
            ask_for("a copy onto the stick", "stick", file, journal);
        };
    }
    options.screen = exhibit.screen.get();
    options.mode = watch::word_of(mode.mode);
    options.settings = Sentence(mode.used.instead);
    return options;
}

/// Prints the error before anything is closed, because a thread that hangs may delay closing until the process ends.
int end_with(const Error& why) {
    const int status = exit_status("frustumscreen", tl::unexpected<Error>(why));
    service::end_within(longest_stop, status);
    return status;
}

/// Returns the exit status, or an error that is not yet printed. Everything is still open.
Result<int> finish(const RunRequest& request, const RunEnd& end, const Result<show::LoopResult>& result,
                   const sound::Sound* sound, const service::Journal& journal) {
    const bool until_told = request.seconds == 0.0;
    switch (end.why) {
    case RunEnd::Why::SetInstalled:
        journal.note(service::LogPriority::Notice,
                     "a set of packs was installed; the exhibit restarts with it", {{"DEVICE", "set"}});
        service::end_within(longest_stop);
        return 0;
    case RunEnd::Why::Failed:
        return until_told ? Result<int>(end_with(*end.error)) : tl::unexpected<Error>(*end.error);
    case RunEnd::Why::Done:
        break;
    }
    if (until_told) {
        service::end_within(longest_stop);
    }
    if (!request.out.empty()) {
        TRY_VOID(write_output(request.out, *result, sound));
    }
    report(request, *result);
    return 0;
}

/// Nothing if visits are not counted. A run in simulated time has no date.
std::unique_ptr<counts::VisitBook> open_visit_book(const RunRequest& request,
                                                   const settings::Settings& settings) {
    std::error_code missing;
    const std::filesystem::path& folder = settings.exhibit.counts;
    const bool counts = !request.fast && !request.pattern && !folder.empty() &&
                        std::filesystem::is_directory(folder, missing);
    return counts ? std::make_unique<counts::VisitBook>(folder, local_offset_at) : nullptr;
}

/// Runs the loop and finishes while its devices are still open, so that a hanging one cannot delay the end.
Result<int> loop_and_finish(const RunRequest& request, const RunMode& mode, OpenExhibit& exhibit,
                            const service::StopSignals& stop_signals, service::ServiceManager& manager,
                            const service::Journal& journal) {
    const settings::Settings& settings = *mode.used.settings;
    show::LoopOptions options = loop_options(request, mode, exhibit, journal);
    options.stop = &stop_signals;
    show::Screenshot screenshot(exhibit.display->width(), exhibit.display->height());
    options.screenshot = request.staff_socket.empty() ? nullptr : &screenshot;
    const std::unique_ptr<service::StaffSocket> staff =
        open_staff_socket(request.staff_socket, screenshot, journal);
    const std::string& zone = settings.hours.time_zone;
    show::RunHours hours(settings.hours, local_offset_at, has_time_zone(zone) ? std::string_view() : zone);
    options.hours = &hours;
    const std::unique_ptr<counts::VisitBook> visits = open_visit_book(request, settings);
    options.visits = visits.get();
    status::StatusPlaces places{.status_file = request.status_file};
    if (show::library_is_there(settings)) {
        places.data_folder = settings.exhibit.library;
    }
    show::StatusFile status_file(std::move(places), keeper_of(request.places, mode));
    show::RunWatch watch(manager, journal);
    const Result<show::LoopResult> result =
        show::run_loop(settings, *exhibit.display, exhibit.inputs, *exhibit.show, options, status_file, watch,
                       exhibit.start);
    manager.stopping();
    const RunEnd end = end_of_run(result, exhibit.error_screen, exhibit.arrival && exhibit.arrival->came());
    return finish(request, end, result, exhibit.inputs.sound.get(), journal);
}

/// Returns the exit status, or an error that is not yet printed.
Result<int> run(RunRequest& request) {
    record_crashes_of(request.places);
    const service::StopSignals stop_signals;
    const service::Journal journal("frustumscreen");
    service::ServiceManager manager;
    TRY(const RunMode mode, load(request, journal));
    const settings::Settings& settings = *mode.used.settings;
    static_cast<void>(use_time_zone(settings.hours.time_zone)); // before a second thread starts
    prepare_driver(request.places, mode.mode, journal);
    keep_stereo(request.places, mode);
    TRY(OpenExhibit exhibit, open(request, settings, stop_signals, manager, journal));
    return loop_and_finish(request, mode, exhibit, stop_signals, manager, journal);
}

} // namespace

int run_command(int argc, char** argv) {
    RunRequest request;
    if (const std::optional<int> end = read_run_arguments(argc, argv, request)) {
        return *end;
    }
    const Result<int> status = run(request);
    return status ? *status : exit_status("frustumscreen", tl::unexpected<Error>(status.error()));
}

} // namespace frustumscreen::programs
