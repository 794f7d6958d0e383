/// Reports the run to the service manager and the journal: ready, alive, state.
///
/// Watched  the presented picture, by a code in it (app/render/probe.h), if a service manager's watchdog or a status
///          file needs it; and the loop, by a thread that reports when the loop is silent.
/// Journal  one line for each change of a device's state, of what is shown, of the installed set, of the watchdog's
///          judgement, and for each step of an import; every line names what is shown in its fields ARTIFACT,
///          LANGUAGE and LEVEL.
/// Time     the loop's `now`. A run on a simulated clock is not watched.
/// Threads  the render thread, with the display's context current; allocates nothing in a frame.
#pragma once

#include "app/show/import_journal.h"
#include "app/show/inputs.h"
#include "app/show/run_report.h"
#include "firmware_host/display/display.h"
#include "firmware_host/service/hang_watch.h"
#include "firmware_host/service/journal.h"
#include "firmware_host/service/service_manager.h"
#include "firmware_host/service/watchdog_policy.h"

#include <optional>

namespace frustumscreen::show {

class RunWatch {
public:
    RunWatch(service::ServiceManager& manager, const service::Journal& journal)
        : manager_(manager), journal_(journal) {}

    /// Silence of the loop that counts as a hang.
    static constexpr Nanoseconds loop_timeout = std::chrono::seconds(4);

    /// Call when the loop begins; `status_file` is informed of a hang.
    void begin(MonotonicTime now, bool simulated_time, StatusFile& status_file);
    /// Call when the loop enters a part of its work; `part` is a literal.
    void enters(const char* part);
    /// Call when a picture was presented; `has_code`: it contains a code. Reads the code back from what the projector
    /// shows if possible, otherwise from the display's framebuffer.
    void presented(MonotonicTime now, const display::Display& display, bool has_code);
    /// Call when no picture is presented, on purpose.
    void asleep(MonotonicTime now) {
        if (watchdog_) {
            watchdog_->asleep(now);
        }
    }
    /// Call in every frame.
    void look(MonotonicTime now, const display::Display& display, const Inputs& inputs);
    /// True once the service manager knows that the run is ready; until then every frame is presented.
    [[nodiscard]] bool ready() const { return ready_; }
    [[nodiscard]] service::Health health() const { return health_; }
    /// The code last read back from what the display shows.
    [[nodiscard]] std::optional<std::uint8_t> shown_code() const { return shown_code_; }
    /// Call once a second.
    void note(const RunStatus& status);
    /// Call when the loop has ended.
    void end() { hang_watch_.reset(); }

private:
    [[nodiscard]] std::optional<std::uint8_t> code_of(const display::Display& display);
    void note_health(service::Health health);
    void note_device(std::string_view device, const Sentence& state, Sentence& noted);
    void note_state(service::LogPriority priority, std::string_view device, std::string_view state,
                    const Sentence& line) const;

    service::ServiceManager& manager_;
    const service::Journal& journal_;
    std::optional<service::WatchdogPolicy> watchdog_;
    bool ready_ = false;
    bool shown_is_readable_ = false; ///< a code has been read from what the projector shows
    service::Health health_ = service::Health::Well;
    std::optional<std::uint8_t> shown_code_;
    status::SharedSetStatus noted_set_;
    bool library_hung_ = false;
    Sentence display_, screen_, tracker_, camera_, drift_, panel_, sound_, recording_, hours_, clock_,
        visits_, set_, artifact_, language_, level_;
    ImportJournal imports_;
    std::optional<service::HangWatch> hang_watch_; ///< last: its thread uses the other members
};

} // namespace frustumscreen::show
