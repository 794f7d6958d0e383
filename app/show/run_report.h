/// A run's records: frame times, the status file, the list of frames.
///
/// Units    milliseconds of wall time from the tracker's poll to the end of the picture, without pacing and file
///          writes.
/// Threads  the render thread. The status file has its own writer thread, so that a slow disk delays no frame.
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

namespace frustumscreen::show {

/// The text on the table in place of the artifact's short text, or beside it.
struct ToldText {
    enum class Kind : std::uint8_t { Nothing, Description, Label, Words };
    Kind kind = Kind::Nothing;
    std::size_t number = 0; ///< of the description's portion, or of the label's hotspot
};

struct FrameRow {
    std::int64_t t_us = 0;
    float ms = 0.0F;
    std::optional<scene::ErrorEstimate> error; ///< nothing: no part of an artifact is shown
    bool drawn = false;
    std::string_view artifact;
    std::string_view technique;
    std::string_view state; ///< of the exhibit (states.h)
    std::string_view language;
    ToldText told;
};

/// CSV: frame,t_us,ms,technique,estimated_error_mm,drawn,artifact,state,language,told,p95_error_mm. `told`:
/// description.K or label.K, as a pack names its texts; `words` for the exhibit's own texts; empty if only the short
/// text is shown.
[[nodiscard]] std::string frames_csv(const std::vector<FrameRow>& rows);

/// The times of the latest frames, in memory allocated at the start.
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

/// The contents of the status file, and values for the exhibit's own picture, sound and journal.
struct RunStatus : status::StatusReport {
    double hour_of_day = 12.0;               ///< local time
    int camera_width = 0, camera_height = 0; ///< of the camera's frames; 0: unknown
    int louder_db = 0;                       ///< relative to the settings, chosen with the staff's buttons
    bool calibrates = false;                 ///< the staff may start the table's calibration with the buttons
    bool copies = false;                     ///< the staff may have a copy of the kiosk written to a stick
    SharedImport seen_import;                ///< the importer's report; null: none
    status::SharedEnvironment environment;   ///< what other programs know; null: not read yet
};
/// The local time of day, 0 to 24.
[[nodiscard]] double local_hour();
/// Sets the status's time, boot time and this process's memory.
void stamp(RunStatus& status);

/// Resident memory of this process; 0 if the system does not say.
[[nodiscard]] double resident_mib();

/// Writes the latest posted status, by rename, and reads as often what other programs know of the exhibit.
class StatusFile {
public:
    /// Without a status file, posts go nowhere. `written`: called on the writer's thread after each status.
    explicit StatusFile(status::StatusPlaces places, std::function<void(const RunStatus&)> written = {});
    ~StatusFile(); ///< writes a pending status
    StatusFile(const StatusFile&) = delete;
    StatusFile& operator=(const StatusFile&) = delete;
    void post(const RunStatus& status);
    /// Reports that the posting thread hangs, or has recovered: the latest status is written again. Any thread may
    /// call.
    void note_hang(bool hangs);
    [[nodiscard]] bool wanted() const { return !places_.status_file.empty(); }
    /// The environment read last; null: none yet, or there is no file.
    [[nodiscard]] status::SharedEnvironment environment();

private:
    void work();

    status::StatusPlaces places_;
    std::function<void(const RunStatus&)> written_;
    std::mutex mutex_;
    std::condition_variable changed_;
    RunStatus latest_;
    status::SharedEnvironment environment_;
    bool hangs_ = false;
    bool pending_ = false;
    bool closing_ = false;
    std::jthread writer_;
};

} // namespace frustumscreen::show
