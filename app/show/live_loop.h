/// The steps of the live loop (run_loop.h), one object for each run.
///
/// Threads  the render thread.
/// Errors   as run_loop.
#pragma once

#include "app/counts/visit_counter.h"
#include "app/show/device_intake.h"
#include "app/show/run_loop.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

namespace frustumscreen::show {

/// Limit for visits that wait to be written; it is reached only if the writer's thread is stuck.
inline constexpr std::size_t max_visit_pieces = 64;

/// Empty if nothing can be shown.
[[nodiscard]] std::string_view shown_artifact(const ShowState& state);

/// Frames are in run_loop.cpp, counts and the status in run_loop_status.cpp.
class LiveLoop {
public:
    LiveLoop(const settings::Settings& settings, display::Display& display, Inputs& inputs, Show& show,
             const LoopOptions& options, StatusFile& status_file, RunWatch& watch, MonotonicTime start);
    [[nodiscard]] Result<LoopResult> run();

private:
    [[nodiscard]] Result<void> frame(MonotonicTime now);
    /// The screen's turn, after the projector's picture, in the time that is left of the frame.
    void step_screen(MonotonicTime now, const tracking::TrackedState& tracked_state, MonotonicTime begin);

    struct Drawn {
        bool presented = false;
        bool changed = false; ///< the picture differs from the previous one
        bool coded = false;   ///< contains a code for the watchdog
    };
    /// Draws what changed, or the same picture again if none was presented for a second.
    [[nodiscard]] Result<Drawn> draw(MonotonicTime now, const tracking::TrackedState& tracked_state);
    /// Applies the exhibit's decisions of this frame: lamps, the request to calibrate, and what the next frame needs.
    void follow_state(MonotonicTime now, const ShowState& state);
    void count_visits(MonotonicTime now, const ShowState& state);
    /// The drift marks are shown only while no visitor is present.
    [[nodiscard]] std::optional<drift::ShownMark> mark(MonotonicTime now);
    /// The camera's picture is only for the staff, and only while they hold both of their buttons.
    void follow_viewfinder(MonotonicTime now);
    /// A press during sleep wakes the exhibit and has no other effect.
    void follow_hours(MonotonicTime now);
    /// Keeps the projector dark; devices are read and reported to the watchdog.
    [[nodiscard]] Result<void> sleep(MonotonicTime now, const tracking::TrackedState& tracked_state,
                                     MonotonicTime begin);
    void count(bool presented, bool changed, MonotonicTime now, double ms);
    void post_status(MonotonicTime now);
    void renew_status(MonotonicTime now);
    [[nodiscard]] bool told_to_stop() const;
    /// Waits for the next display time, unless the run is fast.
    [[nodiscard]] MonotonicTime next_display_time(MonotonicTime now);

    display::Display& display_;
    Inputs& inputs_;
    Show& show_;
    const LoopOptions& options_;
    StatusFile& status_file_;
    RunWatch& watch_;
    RunHours* hours_; ///< none: it never sleeps
    bool asleep_ = false;
    bool attracts_ = false;     ///< in the previous frame no visitor was present
    bool staff_ = false;        ///< in the previous frame the staff picture was shown
    bool shows_camera_ = false; ///< the staff hold their buttons and see the camera's picture
    MonotonicTime start_;
    Nanoseconds period_;
    tracking::LightDelay light_delay_;
    DeviceIntake intake_;
    StillTaker stills_;
    tracking::TrackedState shown_; ///< of the latest frame, as it was drawn
    RecentFrameTimes times_;
    MonotonicTime presented_; ///< when the shown picture was presented
    Sentence artifact_;       ///< on show
    MonotonicTime artifact_since_;
    std::optional<MonotonicTime> fault_since_; ///< since when nothing can be shown
    std::optional<MonotonicTime> used_;        ///< when the exhibit was last used
    counts::VisitCounter visit_counter_;
    std::vector<counts::VisitPiece> visit_pieces_; ///< not taken yet
    counts::CountedVisits visits_;
    std::uint8_t probe_code_ = 0;
    decltype(tracking::TrackedState::torches) torches_{}; ///< of the latest step
    std::size_t rows_expected_ = 0;
    LoopResult result_;
};

} // namespace frustumscreen::show
