/// What a run says about itself: frame times, the status file, the list of frames.
///
/// Units    milliseconds of wall time from the tracker's poll to the picture's end; no pacing, no writing of
///          files.
/// Threads  the render thread, except the status file: its own thread writes, so that a slow disk costs no
///          frame.
#pragma once

#include "app/geometry/transform.h"
#include "app/scene/error_estimate.h"
#include "app/show/import_watch.h"
#include "app/show/set_status.h"
#include "app/status/known_exhibit.h"
#include "firmware_host/base/result.h"
#include "firmware_host/base/sentence.h"
#include "firmware_host/base/time.h"
#include "firmware_host/service/watchdog_policy.h"
#include "firmware_host/tracker/tracker.h"

#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

namespace frustumscreen {

/// The text on the table in place of the artifact's short one, or beside it.
struct ToldText {
    enum class Kind : std::uint8_t { Nothing, Description, Label, Words };
    Kind kind = Kind::Nothing;
    std::size_t number = 0; ///< the description's portion, the label's hotspot
};

struct FrameRow {
    std::int64_t t_us = 0;
    float ms = 0.0F;
    std::optional<ErrorEstimate> error; ///< nothing: nothing of an artifact is shown
    bool drawn = false;
    std::string_view artifact;
    std::string_view technique;
    std::string_view state; ///< of the exhibit (states.h)
    std::string_view language;
    ToldText told;
};

/// CSV: frame,t_us,ms,technique,estimated_error_mm,drawn,artifact,state,language,told,p95_error_mm. `told`: description.K, label.K as a pack
/// names its texts; `words`, the exhibit's own; empty where only the short text is shown.
[[nodiscard]] std::string frames_csv(const std::vector<FrameRow>& rows);

/// The latest frames' times, in memory taken at the start.
class RecentFrameTimes {
public:
    explicit RecentFrameTimes(std::size_t window);
    void add(double ms);
    /// The value below which `share` of the window's frames lie; 0 if there are no frames.
    [[nodiscard]] double quantile(double share);

private:
    std::vector<float> window_;
    std::vector<float> sorted_;
    std::size_t count_ = 0;
};

/// A pack that was asked for and cannot be shown.
struct PackLeftOut {
    std::string pack;
    std::string reason;
};

/// It never changes.
using PacksLeftOut = std::shared_ptr<const std::vector<PackLeftOut>>;

/// Messages about a pack begin with its file.
[[nodiscard]] PackLeftOut pack_left_out(const std::string& pack, std::string_view message);

/// The picture that was handed to the display last, and what it shows.
struct PresentedPicture {
    std::optional<std::uint8_t> code; ///< app/render/probe.h; nothing = the picture lights its corner
    RigidTransform table_from_prop;   ///< as drawn
    glm::dvec3 eye_m{0.0};            ///< table frame
    bool settled = false;             ///< nothing in it fades
};

/// What the timetable says, and whether the exhibit follows it (run_hours.h).
struct HoursStatus {
    std::string_view state{"always"};              ///< always, open, closed, clock_wrong
    std::optional<std::chrono::sys_seconds> until; ///< none: for long
    Sentence why;                                  ///< it is awake or asleep; empty: it has no timetable
    Sentence clock; ///< when the wall clock was set, and by how much; empty: never
    bool asleep = false;
};

/// What the camera's frames are used for.
struct CameraUses {
    bool tags = false;
    bool visitor = false;
    bool drift = false;
};

struct RunStatus {
    std::chrono::system_clock::time_point written_at; ///< `stamp` sets these four when the status is written
    MonotonicTime written_at_monotonic;
    Sentence boot_id;
    double resident_mib = 0.0;
    Health health = Health::Well;
    PresentedPicture presented;
    std::optional<std::uint8_t> shown_code; ///< last read back from what the display shows
    TrackerCounts tracker_counts;
    PacksLeftOut left_out;      ///< none: there are none
    SharedSetStatus set;        ///< none: no set is installed, and none is looked for
    bool library_hangs = false; ///< who looks for another set hangs on the disk; what is shown goes on
    std::string_view state;     ///< name_of(State); this and the other texts live as long as the show
    std::string_view artifact;
    std::string_view technique; ///< as asked for: "auto" is the governor's choice
    std::string_view level;
    std::string_view language;
    std::chrono::system_clock::time_point shown_since; ///< of this artifact, by the wall clock
    double shown_for_s = 0.0;                          ///< the same by the run's own
    int samples = 0;                                   ///< a pixel
    std::optional<ErrorEstimate> error; ///< of what was shown last; nothing: it was nothing of an artifact
    double median_ms = 0.0;             ///< of the frames that were drawn
    double p95_ms = 0.0;
    double p99_ms = 0.0;
    std::uint64_t missed_deadlines = 0; ///< frames drawn that took longer than one refresh
    std::uint64_t level_switches = 0;   ///< of level or samples, by the governors
    std::uint64_t ignored_times = 0;    ///< frame times that are not times, see Governor
    std::uint64_t probes = 0;           ///< pictures at rest that were presented again
    std::uint64_t frames = 0;
    std::uint64_t drawn = 0;
    std::uint64_t unchanged = 0;   ///< nothing had changed: nothing was drawn
    std::uint64_t late = 0;        ///< display times that passed without a new frame
    std::uint64_t bad_samples = 0; ///< samples that were no pose; polls that were answered with an error
    double uptime_s = 0.0;
    std::string_view mode =
        "normal";      ///< what is shown at all, as --mode-file says: a word of app/watch/step.h
    Sentence settings; ///< why others than those of the file are used; empty: they are those of the file
    Sentence display;  ///< states of the devices; empty where there is nothing to say
    Sentence tracker;
    bool tracker_hangs = false;              ///< Tracker::hangs
    Sentence camera;                         ///< empty: there is none
    double camera_hz = 0.0;                  ///< frames that came of late
    int camera_width = 0, camera_height = 0; ///< of its frames; 0: not known; for the staff's picture alone
    CameraUses camera_for;
    Sentence drift;                ///< whether the picture lies where it was calibrated; empty: nothing looks
    std::optional<double> drift_m; ///< how far beside it; nothing: not known
    bool drifted = false;          ///< so far that it is to be put right
    std::string_view prop_by;      ///< "tracker" or "tags", a literal; empty: neither is there
    std::uint64_t hand_overs = 0;
    std::string_view eye_by = "settings"; ///< "sensor", "camera" or "settings", a literal
    double eye_sd_m = 0.0;                ///< of an eye by the camera, Situation::eye_sd_m
    Sentence panel;
    Sentence sound;
    Sentence recording;
    std::uint64_t sound_underruns = 0; ///< how often the loudspeaker had nothing to play
    double hour_of_day = 12.0;         ///< local time
    HoursStatus hours;
    bool prop_known = false;
    bool head_known = false;
    bool calibrates =
        false; ///< the staff may begin the table's calibration with the buttons; for their page alone
    std::size_t loaded = 0; ///< artifacts that can be shown at once
    std::uint64_t loaded_bytes = 0;
    SharedImport import;             ///< what the importer says; none: nothing
    SharedSurroundings surroundings; ///< what others know; none: nobody has asked them yet
};
/// docs/status.md has the fields.
[[nodiscard]] std::string status_json(const RunStatus& status);
/// Of this machine's place, 0 to 24.
[[nodiscard]] double local_hour();
/// Sets the time, the boot and this process's memory at which the status is written.
void stamp(RunStatus& status);

/// Resident memory of this process; 0 if the system does not say.
[[nodiscard]] double resident_mib();

/// Writes the latest status posted, by rename; and reads, as often, what others know of the exhibit.
class StatusFile {
public:
    /// An empty path: posts go nowhere. `written`: called on the writer's thread after each status.
    explicit StatusFile(std::filesystem::path file, std::function<void(const RunStatus&)> written = {});
    ~StatusFile(); ///< writes what is still to be written
    StatusFile(const StatusFile&) = delete;
    StatusFile& operator=(const StatusFile&) = delete;
    void post(const RunStatus& status);
    /// The thread that posts hangs, or no longer hangs: the latest status is written again. Any thread may
    /// call.
    void note_hang(bool hangs);
    [[nodiscard]] bool wanted() const { return !file_.empty(); }
    /// What was read last; none: nothing yet, or there is no file.
    [[nodiscard]] SharedSurroundings surroundings();

private:
    void work();

    std::filesystem::path file_;
    std::function<void(const RunStatus&)> written_;
    std::mutex mutex_;
    std::condition_variable changed_;
    RunStatus latest_;
    SharedSurroundings surroundings_;
    bool hangs_ = false;
    bool pending_ = false;
    bool closing_ = false;
    std::jthread writer_;
};

} // namespace frustumscreen
