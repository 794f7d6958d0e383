/// The exhibit's report on itself, once a second: the contents of its status file.
///
/// describe_status.h describes each field once; docs/status.md gives its meaning. When a file is read, a field that
/// is missing or of another type is nothing: empty, 0, false.
///
/// Threads  values; any. Shared values never change.
#pragma once

#include "app/library/import_report.h"
#include "app/library/unshown_pack.h"
#include "app/pack/pack_file.h"
#include "app/status/set_status.h"
#include "firmware_host/base/device_state.h"
#include "firmware_host/base/json.h"
#include "firmware_host/base/sentence.h"
#include "firmware_host/base/time.h"
#include "firmware_host/base/version.h"
#include "firmware_host/tracker/tracker.h"

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace frustumscreen::status {

/// When a status was written: the exhibit's or its watchdog's.
struct StatusStamp {
    std::chrono::system_clock::time_point at;
    std::optional<MonotonicTime> monotonic = MonotonicTime(); ///< nothing: unknown
    Sentence boot_id;
};

struct StatusVersions {
    std::string program = std::string(project_version());
    int pack_format = pack::pack_format_version;
    std::string system; ///< operating system and kernel
};

/// The picture that was handed to the display last, and the poses it was drawn for, in the table's frame.
struct PresentedPicture {
    std::optional<std::uint8_t> code; ///< app/render/probe.h; nothing: the picture lights its corner
    std::array<double, 3> prop_m{};
    std::array<double, 4> prop_wxyz{1.0, 0.0, 0.0, 0.0};
    std::array<double, 3> eye_m{};
    bool settled = false; ///< nothing in it fades
};

/// The timetable's state, and whether the exhibit follows it (app/show/run_hours.h).
struct HoursStatus {
    std::string state{"always"};                   ///< always, open, closed, clock_wrong
    std::optional<std::chrono::sys_seconds> until; ///< none: for a long time
    Sentence why;   ///< why the exhibit is awake or asleep; empty: it has no timetable
    Sentence clock; ///< when the wall clock was set, and by how much; empty: never
    bool asleep = false;
};

/// Upper bound of the drawn frames' times: for half of them, for 95 and for 99 of 100.
struct FrameQuantiles {
    std::optional<double> p50 = 0.0;
    std::optional<double> p95 = 0.0;
    std::optional<double> p99 = 0.0;
};

/// One device: whether it can be used.
struct DeviceReport {
    std::optional<bool> ok; ///< nothing: the settings ask for none
    bool impaired = false;  ///< it can be used, but needs attention
    std::string id;         ///< MessageId of its sentence; empty: it has none

    DeviceReport() = default;
    explicit DeviceReport(const DeviceCondition& condition)
        : ok(condition.health == DeviceHealth::None ? std::nullopt
                                                    : std::optional(condition.health != DeviceHealth::Away)),
          impaired(condition.health == DeviceHealth::Impaired), id(condition.id.view()) {}
};
struct DeviceReports {
    DeviceReport display, screen, tracker, camera, panel, sound;
};

/// Visitors as numbers alone (app/counts).
struct VisitsReport {
    std::uint64_t today = 0; ///< visits that began today, by local time
    std::uint64_t since_start = 0;
    double today_s = 0.0; ///< total duration of these visits
    double since_start_s = 0.0;
    std::string trouble; ///< a sentence: the numbers cannot be kept; empty: no trouble
    [[nodiscard]] bool operator==(const VisitsReport&) const = default;
};

/// The program that writes the report.
struct ProgramStatus {
    StatusStamp written;
    StatusVersions versions;
    std::string health{"well"}; ///< word_of(Health)
    std::optional<double> uptime_s = 0.0;
    std::optional<double> resident_mib = 0.0;
};

/// The shown artifact and its source.
struct ShownStatus {
    PresentedPicture presented;
    std::optional<std::uint8_t> shown_code; ///< last read back from what the display shows
    std::string mode{"normal"};             ///< word_of(Mode)
    Sentence settings;
    library::UnshownPacks left_out; ///< null: none
    SharedSetStatus set;            ///< null: no set is installed, and none is looked for
    bool library_hangs = false; ///< the thread that looks for another set hangs on the disk; see trouble_of
    std::string state;          ///< name_of(State), or asleep_name
    HoursStatus hours;
    std::string artifact;
    std::chrono::system_clock::time_point shown_since; ///< start of showing this artifact, by the wall clock
    std::optional<double> shown_for_s = 0.0;           ///< the same, by the run's own clock
    std::size_t loaded = 0;                            ///< artifacts that can be shown at once
    std::uint64_t loaded_bytes = 0;
    std::string language;
};

/// How the artifact is drawn.
struct DrawingStatus {
    std::string technique; ///< as asked for; "auto": the governor chooses
    std::string level;
    int samples = 0;                          ///< per pixel
    std::optional<double> estimated_error_mm; ///< of the last picture; nothing: it shows no artifact
    std::optional<double> p95_error_mm;
    FrameQuantiles frame_ms;
    std::uint64_t missed_deadlines = 0; ///< drawn frames that took longer than one refresh
    std::uint64_t level_switches = 0;   ///< of level or samples, by the governors
    std::uint64_t ignored_times = 0;    ///< impossible frame times, see Governor
};

/// Looks at the devices, one for each display time.
struct LookCounts {
    std::uint64_t frames = 0;
    std::uint64_t drawn = 0;
    std::uint64_t unchanged = 0;     ///< nothing had changed, so nothing was drawn
    std::uint64_t probes = 0;        ///< pictures at rest that were presented again
    std::uint64_t skipped = 0;       ///< display times that passed without a new frame
    std::uint64_t device_errors = 0; ///< samples that were no pose; polls answered with an error
};

/// The pictures on the screen behind the table.
struct ScreenReport {
    std::string health{"well"};             ///< word_of(Health), of this output alone
    std::optional<std::uint8_t> code;       ///< as PresentedPicture
    std::optional<std::uint8_t> shown_code; ///< as ShownStatus
    std::uint64_t presented = 0;
    std::uint64_t drawn = 0;   ///< pictures that differ from the one before
    std::uint64_t held_up = 0; ///< frames in which the screen had not shown the picture before
    FrameQuantiles frame_ms;   ///< of the drawn pictures
};

/// State of the devices.
struct DeviceStatus {
    DeviceReports devices;
    Sentence display; ///< state of the device, as those below; empty: nothing to report
    Sentence screen;
    std::optional<ScreenReport> screen_picture; ///< nothing: the settings have no screen
    Sentence tracker;
    bool tracker_hangs = false; ///< Tracker::hangs
    tracker::TrackerCounts tracker_counts;
    Sentence camera;        ///< empty: there is none
    double camera_hz = 0.0; ///< recent frame rate
    std::string camera_for; ///< camera_uses()
    Sentence panel;
    Sentence sound;
    std::uint64_t sound_underruns = 0; ///< how often the loudspeaker had nothing to play
    Sentence recording;
};

/// Whether the picture lies where it was calibrated.
struct DriftStatus {
    Sentence drift;                ///< whether the picture lies where it was calibrated; empty: not measured
    std::optional<double> drift_m; ///< distance from there; nothing: unknown
    bool drifted = false;          ///< too far: the exhibit must be calibrated again
};

/// The poses of prop and eye, and their sources.
struct TrackedStatus {
    std::string prop_by; ///< tracker or tags; empty: neither is there
    std::uint64_t source_changes = 0;
    bool prop_known = false;
    bool head_known = false;
    std::string eye_by{"settings"}; ///< sensor, camera or settings
    std::optional<double> eye_sd_m; ///< of an eye measured by the camera, TrackedState::eye_sd_m
};

/// The torch in the hand; if none is held, the one that is seen.
struct TorchReport {
    std::string by;            ///< tracker or tag; empty: none is seen
    std::string state{"lost"}; ///< lit, past, too_far, dark, laid_down or lost
    std::string content;       ///< name in the pack, or white; empty: none is held
};

/// The fields in groups by subject.
struct StatusReport : ProgramStatus,
                      ShownStatus,
                      DrawingStatus,
                      LookCounts,
                      DeviceStatus,
                      DriftStatus,
                      TrackedStatus {
    std::shared_ptr<const library::ImportReport> import; ///< the importer's report; null: none
    std::optional<TorchReport> torch;                    ///< nothing: there are no torches
    std::optional<VisitsReport> visits;                  ///< nothing: visits are not counted
};

/// The status file's text.
[[nodiscard]] std::string status_json(const StatusReport& report);
/// Reads any JSON.
[[nodiscard]] StatusReport read_status_report(const nlohmann::json& document);
/// The rows for the fields in docs/status.md.
[[nodiscard]] std::string status_field_table();

/// The set's trouble, as the status reports it.
[[nodiscard]] inline std::string trouble_of(const SetStatus& set, bool library_hangs) {
    return library_hangs ? std::string(library_hangs_sentence) : set.trouble;
}
[[nodiscard]] inline std::string& trouble_of(SetStatus& set, bool /*library_hangs*/) {
    return set.trouble;
}

} // namespace frustumscreen::status
