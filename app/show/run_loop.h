/// The live loop: poll, decide, draw what changed, present, wait for the next display time.
///
/// Time     every decision of a frame uses one `now`. In real time it is the monotonic clock; in a fast run it
///          advances by one period, so that the run is repeatable and as fast as the machine allows.
/// Threads  the render thread, with the display's context current. Allocates nothing of its own in a frame.
/// Errors   the display stops; no artifact could be shown for `longest_fault`. Failing devices are counted and polled
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

#include <functional>
#include <optional>
#include <vector>

namespace frustumscreen::show {

/// After this time without an artifact the run ends, so that a restart looks for packs again.
inline constexpr Nanoseconds longest_fault = std::chrono::minutes(1);

class ScreenOutput;

struct LoopOptions {
    std::optional<Nanoseconds> length; ///< nothing: until stopped
    bool fast = false;
    render::Redraw redraw = render::Redraw::Changes;
    int stills = 0; ///< pictures to keep, spread over `length`
    bool keep_rows = false;
    std::string_view mode = "normal"; ///< `mode` and `settings` are for the status
    Sentence settings;
    const service::StopSignals* stop = nullptr; ///< a stop signal ends the loop
    Screenshot* screenshot = nullptr;           ///< of the display's size; serves requests for a picture
    std::function<bool()> ends = {};            ///< called in each frame; true ends the loop
    std::function<void()> calibrate = {};       ///< starts the calibration for the staff; none: not available
    std::function<void()> reset = {};    ///< starts the return to the state of delivery; none: not available
    std::function<void()> copy = {};     ///< starts the copy to the stick that waits; none: not available
    counts::VisitBook* visits = nullptr; ///< counts visits; none: they are not counted, as in a fast run
    ScreenOutput* screen = nullptr;      ///< behind the table; none: the settings have none
    RunHours* hours = nullptr; ///< opening hours; none: it never sleeps, as in a fast run or with a pattern
};

struct LoopResult {
    RunStatus status;
    std::vector<Still> stills;
    std::vector<Still> screen_stills;
    std::vector<FrameRow> rows;
    double first_resident_mib = 0.0; ///< after the first tenth of the run
};

[[nodiscard]] Result<LoopResult> run_loop(const settings::Settings& settings, display::Display& display,
                                          Inputs& inputs, Show& show, const LoopOptions& options,
                                          StatusFile& status_file, RunWatch& watch, MonotonicTime start);

} // namespace frustumscreen::show
