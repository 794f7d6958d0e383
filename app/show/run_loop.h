/// The live loop: poll, decide, draw what changed, present, wait for the next display time.
///
/// Time     every decision is made for one `now` a frame. In real time that is the monotonic clock; in a fast
///          run it steps by one period, so that the run is repeatable and as quick as the machine allows.
/// Threads  the render thread, with the display's context current. Allocates nothing of its own in a frame.
/// Errors   the display stops; no artifact can be shown any more, for `longest_fault`. Devices that fail are counted and asked
///          again.
#pragma once

#include "app/counts/visit_book.h"
#include "app/settings/settings.h"
#include "app/show/inputs.h"
#include "app/show/run_hours.h"
#include "app/show/run_report.h"
#include "app/show/run_watch.h"
#include "app/show/screenshot.h"
#include "app/show/show.h"
#include "app/show/still_taker.h"
#include "app/tracking/tracked_state.h"
#include "firmware_host/base/result.h"
#include "firmware_host/display/display.h"
#include "firmware_host/service/stop_signals.h"

#include <filesystem>
#include <functional>
#include <optional>
#include <vector>

namespace frustumscreen {

/// Then the exhibit is to be started again, and looks for packs again.
inline constexpr Nanoseconds longest_fault = std::chrono::minutes(1);

struct LoopOptions {
    std::optional<Nanoseconds> length; ///< nothing = until told to stop
    bool fast = false;
    Redraw redraw = Redraw::Changes;
    int stills = 0; ///< pictures to keep, spread over `length`
    bool keep_rows = false;
    std::string_view mode = "normal"; ///< this and the next for the status
    Sentence settings;
    const StopSignals* stop = nullptr;    ///< one of them ends the loop
    Screenshot* screenshot = nullptr;     ///< of the display's size; whoever asks it for a picture gets one
    std::function<bool()> ends = {};      ///< asked in each frame: yes ends it too
    std::function<void()> calibrate = {}; ///< the staff ask for the table's calibration; none: they cannot
    VisitBook* visits = nullptr;          ///< where visits are counted; none: nowhere, like a fast run
    RunHours* hours = nullptr; ///< by which it sleeps; none: never, like a fast run and an alignment pattern
};

struct LoopResult {
    RunStatus status;
    std::vector<Still> stills;
    std::vector<FrameRow> rows;
    double first_resident_mib = 0.0; ///< after the first tenth of the run
};

[[nodiscard]] Result<LoopResult> run_loop(const Settings& settings, Display& display, Inputs& inputs,
                                          Show& show, const LoopOptions& options, StatusFile& status_file,
                                          RunWatch& watch, MonotonicTime start);

} // namespace frustumscreen
