/// Tells the service manager and the journal about the run: ready, alive, in which state.
///
/// Watched  what is presented, by a code in it (app/render/probe.h), if a service manager's watchdog or a
///          status file needs it; the loop itself, by a thread that reports when the loop is silent.
/// Journal  one line for each change of a device's state, of what is shown, of the installed set, and of the watchdog's opinion,
///          and for what is done with a stick; every line has what is shown in its fields ARTIFACT, LANGUAGE and LEVEL.
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

namespace frustumscreen {

class RunWatch {
public:
    RunWatch(ServiceManager& manager, const Journal& journal) : manager_(manager), journal_(journal) {}

    /// Four seconds without a word from the loop are a hang.
    static constexpr Nanoseconds loop_patience = std::chrono::seconds(4);

    /// The loop begins; `status_file` is told of a hang.
    void begin(MonotonicTime now, bool simulated_time, StatusFile& status_file);
    /// The loop goes on to this part of its work; `part` is a literal.
    void enters(const char* part);
    /// A picture was presented; `has_code`: a code was written into it. It looks at what the projector shows
    /// if that can be read, else at the display's framebuffer.
    void presented(MonotonicTime now, const Display& display, bool has_code);
    /// No picture is presented, on purpose.
    void asleep(MonotonicTime now) {
        if (watchdog_) {
            watchdog_->asleep(now);
        }
    }
    /// Call in every frame.
    void look(MonotonicTime now, const Display& display, const Inputs& inputs);
    /// The service manager was told that the run is ready; until then every frame is presented.
    [[nodiscard]] bool ready() const { return ready_; }
    [[nodiscard]] Health health() const { return health_; }
    /// The code last read back from what the display shows.
    [[nodiscard]] std::optional<std::uint8_t> shown_code() const { return shown_code_; }
    /// Call once a second.
    void note(const RunStatus& status);
    /// The loop has ended.
    void end() { hang_watch_.reset(); }

private:
    [[nodiscard]] std::optional<std::uint8_t> code_of(const Display& display);
    void note_health(Health health);
    void note_device(std::string_view device, const Sentence& state, Sentence& noted);
    void note_state(LogPriority priority, std::string_view device, std::string_view state,
                    const Sentence& line) const;

    ServiceManager& manager_;
    const Journal& journal_;
    std::optional<WatchdogPolicy> watchdog_;
    bool ready_ = false;
    bool shown_is_readable_ = false; ///< a code was read from what the projector shows
    Health health_ = Health::Well;
    std::optional<std::uint8_t> shown_code_;
    SharedSetStatus noted_set_;
    bool library_hung_ = false;
    Sentence display_, tracker_, camera_, drift_, panel_, sound_, recording_, hours_, clock_, visits_, set_,
        artifact_, language_, level_;
    ImportJournal imports_;
    std::optional<HangWatch> hang_watch_; ///< last: its thread uses the above
};

} // namespace frustumscreen
