/// What a run says about itself: frame times, the status file, the list of frames.
///
/// Units    milliseconds of wall time from the tracker's poll to the picture's end; no pacing, no writing of
///          files.
/// Threads  the render thread, except the status file: its own thread writes, so that a slow disk costs no
///          frame.
#pragma once

#include "app/scene/error_estimate.h"
#include "app/show/import_watch.h"
#include "app/status/known_exhibit.h"
#include "app/status/status_report.h"
#include "firmware_host/base/result.h"
#include "firmware_host/base/time.h"

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

/// What the status file has, and what only the exhibit's own picture, sound and journal need.
struct RunStatus : StatusReport {
    double hour_of_day = 12.0;               ///< local time
    int camera_width = 0, camera_height = 0; ///< of the camera's frames; 0: not known
    int louder_db = 0;                       ///< than the settings say, by the staff's buttons
    bool calibrates = false;                 ///< the staff may begin the table's calibration with the buttons
    SharedImport seen_import;                ///< what the importer says; none: nothing
    SharedEnvironment environment;           ///< what others know; none: nobody has asked them yet
};
/// Of this machine's place, 0 to 24.
[[nodiscard]] double local_hour();
/// Sets the time, the boot and this process's memory at which the status is written.
void stamp(RunStatus& status);

/// Resident memory of this process; 0 if the system does not say.
[[nodiscard]] double resident_mib();

/// Writes the latest status posted, by rename; and reads, as often, what others know of the exhibit.
class StatusFile {
public:
    /// Without a status file, posts go nowhere. `written`: called on the writer's thread after each status.
    explicit StatusFile(StatusPlaces places, std::function<void(const RunStatus&)> written = {});
    ~StatusFile(); ///< writes what is still to be written
    StatusFile(const StatusFile&) = delete;
    StatusFile& operator=(const StatusFile&) = delete;
    void post(const RunStatus& status);
    /// The thread that posts hangs, or no longer hangs: the latest status is written again. Any thread may
    /// call.
    void note_hang(bool hangs);
    [[nodiscard]] bool wanted() const { return !places_.status_file.empty(); }
    /// What was read last; none: nothing yet, or there is no file.
    [[nodiscard]] SharedEnvironment environment();

private:
    void work();

    StatusPlaces places_;
    std::function<void(const RunStatus&)> written_;
    std::mutex mutex_;
    std::condition_variable changed_;
    RunStatus latest_;
    SharedEnvironment environment_;
    bool hangs_ = false;
    bool pending_ = false;
    bool closing_ = false;
    std::jthread writer_;
};

} // namespace frustumscreen
