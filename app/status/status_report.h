/// What the exhibit says of itself, once a second: the contents of its status file.
///
/// describe_status.h describes each field once; docs/status.md says what it means. Read from a file, a field that is missing there, or
/// is of another type, is nothing: empty, 0, false.
///
/// Threads  values; any. What is shared never changes.
#pragma once

#include "app/library/import_report.h"
#include "app/library/pack_left_out.h"
#include "app/pack/pack_file.h"
#include "app/status/set_status.h"
#include "firmware_host/base/device_state.h"
#include "firmware_host/base/json.h"
#include "firmware_host/base/sentence.h"
#include "firmware_host/base/time.h"
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

namespace frustumscreen {

/// When a status was written, the exhibit's or its watchdog's.
struct StatusStamp {
    std::chrono::system_clock::time_point at;
    std::optional<MonotonicTime> monotonic = MonotonicTime(); ///< nothing: it does not say
    Sentence boot_id;
};

struct StatusVersions {
    std::string program = FRUSTUMSCREEN_VERSION;
    int pack_format = pack_format_version;
    std::string system; ///< operating system and kernel
};

/// The picture that was handed to the display last, and what it shows; poses are in the table's frame, as drawn.
struct PresentedPicture {
    std::optional<std::uint8_t> code; ///< app/render/probe.h; nothing = the picture lights its corner
    std::array<double, 3> prop_m{};
    std::array<double, 4> prop_wxyz{1.0, 0.0, 0.0, 0.0};
    std::array<double, 3> eye_m{};
    bool settled = false; ///< nothing in it fades
};

/// What the timetable says, and whether the exhibit follows it (app/show/run_hours.h).
struct HoursStatus {
    std::string state{"always"};                   ///< always, open, closed, clock_wrong
    std::optional<std::chrono::sys_seconds> until; ///< none: for long
    Sentence why;                                  ///< it is awake or asleep; empty: it has no timetable
    Sentence clock; ///< when the wall clock was set, and by how much; empty: never
    bool asleep = false;
};

/// Of the frames that were drawn, how long half of them, 95 and 99 of 100 took at most.
struct FrameQuantiles {
    std::optional<double> p50 = 0.0;
    std::optional<double> p95 = 0.0;
    std::optional<double> p99 = 0.0;
};

/// Of one device: whether it can be used.
struct DeviceReport {
    std::optional<bool> ok; ///< nothing: the settings ask for none
    bool impaired = false;  ///< it can be used, and something about it is to be put right
    std::string id;         ///< of the sentence that it says, MessageId; empty: it says none

    DeviceReport() = default;
    explicit DeviceReport(const DeviceCondition& condition)
        : ok(condition.health == DeviceHealth::None ? std::nullopt
                                                    : std::optional(condition.health != DeviceHealth::Away)),
          impaired(condition.health == DeviceHealth::Impaired), id(condition.id.view()) {}
};
struct DeviceReports {
    DeviceReport display, tracker, camera, panel, sound;
};

/// Of visitors, numbers alone (app/counts).
struct VisitsReport {
    std::uint64_t today = 0; ///< visits that began on this day, by local time
    std::uint64_t since_start = 0;
    double today_s = 0.0; ///< how long they lasted together
    double since_start_s = 0.0;
    std::string trouble; ///< a sentence: the numbers cannot be kept; empty: they are
    [[nodiscard]] bool operator==(const VisitsReport&) const = default;
};

struct StatusReport {
    StatusStamp written;
    StatusVersions versions;
    std::string health{"well"}; ///< word_of(Health)
    PresentedPicture presented;
    std::optional<std::uint8_t> shown_code; ///< last read back from what the display shows
    std::string mode{"normal"};             ///< word_of(Mode)
    Sentence settings;
    PacksLeftOut left_out;      ///< none: there are none
    SharedSetStatus set;        ///< none: no set is installed, and none is looked for
    bool library_hangs = false; ///< who looks for another set hangs on the disk; see trouble_of
    std::string state;          ///< name_of(State), or asleep_name
    HoursStatus hours;
    std::string artifact;
    std::chrono::system_clock::time_point shown_since; ///< of this artifact, by the wall clock
    std::optional<double> shown_for_s = 0.0;           ///< the same by the run's own
    std::size_t loaded = 0;                            ///< artifacts that can be shown at once
    std::uint64_t loaded_bytes = 0;
    std::string technique; ///< as asked for: "auto" is the governor's choice
    std::string level;
    int samples = 0; ///< a pixel
    std::string language;
    std::optional<double> estimated_error_mm; ///< of what was shown last; nothing: nothing of an artifact
    std::optional<double> p95_error_mm;
    FrameQuantiles frame_ms;
    std::uint64_t missed_deadlines = 0; ///< frames drawn that took longer than one refresh
    std::uint64_t level_switches = 0;   ///< of level or samples, by the governors
    std::uint64_t ignored_times = 0;    ///< frame times that are not times, see Governor
    std::uint64_t frames = 0;
    std::uint64_t drawn = 0;
    std::uint64_t unchanged = 0;     ///< nothing had changed: nothing was drawn
    std::uint64_t probes = 0;        ///< pictures at rest that were presented again
    std::uint64_t skipped = 0;       ///< display times that passed without a new frame
    std::uint64_t device_errors = 0; ///< samples that were no pose; polls that were answered with an error
    DeviceReports devices;
    Sentence display; ///< states of the devices; empty where there is nothing to say
    Sentence tracker;
    bool tracker_hangs = false; ///< Tracker::hangs
    TrackerCounts tracker_counts;
    Sentence camera;               ///< empty: there is none
    double camera_hz = 0.0;        ///< frames that came of late
    std::string camera_for;        ///< camera_uses()
    Sentence drift;                ///< whether the picture lies where it was calibrated; empty: nothing looks
    std::optional<double> drift_m; ///< how far beside it; nothing: not known
    bool drifted = false;          ///< so far that it is to be put right
    std::string prop_by;           ///< tracker or tags; empty: neither is there
    std::uint64_t hand_overs = 0;
    Sentence panel;
    Sentence sound;
    std::uint64_t sound_underruns = 0; ///< how often the loudspeaker had nothing to play
    Sentence recording;
    std::shared_ptr<const ImportReport> import; ///< what the importer says; none: nothing
    std::optional<VisitsReport> visits;         ///< nothing: they are not counted
    bool prop_known = false;
    bool head_known = false;
    std::string eye_by{"settings"}; ///< sensor, camera or settings
    std::optional<double> eye_sd_m; ///< of an eye by the camera, Situation::eye_sd_m
    std::optional<double> uptime_s = 0.0;
    std::optional<double> resident_mib = 0.0;
};

/// The status file's text.
[[nodiscard]] std::string status_json(const StatusReport& report);
/// Of any JSON.
[[nodiscard]] StatusReport read_status_report(const nlohmann::json& document);
/// The rows of its fields in docs/status.md.
[[nodiscard]] std::string status_field_table();

/// What the status says of its set's trouble.
[[nodiscard]] inline std::string trouble_of(const SetStatus& set, bool library_hangs) {
    return library_hangs ? std::string(library_hangs_sentence) : set.trouble;
}
[[nodiscard]] inline std::string& trouble_of(SetStatus& set, bool /*library_hangs*/) {
    return set.trouble;
}

} // namespace frustumscreen
