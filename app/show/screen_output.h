/// The screen behind the table in a run: its display, the room's picture on it, and what the status says of both.
///
/// Pace     `step` follows the projector's picture in each frame. A picture is drawn only once the screen shows the one
///          before, so the projector never waits for the screen; nothing is drawn again that did not change.
/// Lost     a display that fails is closed and reported. It is opened again when the exhibit is idle, because opening reads
///          the room. A room that cannot be read is reported, and not read again.
/// Context  the screen's is current only within a call; afterwards the projector's is.
/// Time     parameters; the room's time begins with the run.
/// Threads  the render thread. `step` allocates nothing, unless it opens the screen.
/// Errors   none: `tell` has a sentence.
#pragma once

#include "app/render/renderer.h"
#include "app/room/taking.h"
#include "app/scene/stereo.h"
#include "app/settings/settings.h"
#include "app/show/run_report.h"
#include "app/show/still_taker.h"
#include "app/tracking/tracked_state.h"
#include "firmware_host/base/result.h"
#include "firmware_host/display/display.h"
#include "firmware_host/service/watchdog_policy.h"

#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace frustumscreen::show {

/// A picture of the room, as RoomShow draws it.
struct RoomFrame {
    double seconds = 0.0;
    double light = 1.0;     ///< factor of linear light, 0..1
    double budget_us = 0.0; ///< that the projector's picture has left
    std::optional<double> before_ms =
        std::nullopt; ///< time that the previous picture took until it was complete
    std::span<const room::TakenPose> taken = {};
    std::span<const glm::dvec3> eyes_m = {};
    render::RenderTarget target;
    render::Redraw redraw = render::Redraw::Changes;
};
using DrawRoom = std::function<render::DrawResult(const RoomFrame& frame)>;

/// How the parts of the screen are made, with the display's context current for the room.
struct ScreenParts {
    std::function<Result<std::unique_ptr<display::Display>>()> make_display;
    std::function<Result<DrawRoom>()> make_room;
};
/// The room of the settings. `live`: as RoomShowOptions. A pack that cannot be read is reported on standard error.
[[nodiscard]] std::function<Result<DrawRoom>()> room_of(const settings::Settings& settings, bool live);

struct ScreenFrame {
    MonotonicTime now;
    const tracking::TrackedState& tracked_state;
    double light = 1.0;
    bool asleep = false; ///< dark on purpose
    bool unused = false; ///< nobody uses the exhibit, so that a picture may be late
    double budget_us = std::numeric_limits<double>::infinity(); ///< until the next frame begins
    std::span<const room::TakenPose> taken = {}; ///< the room's objects that are not in their places
    render::Redraw redraw = render::Redraw::Changes;
};

class ScreenOutput {
public:
    static constexpr Nanoseconds between_tries = std::chrono::seconds(10);

    /// Opens the screen. The settings must have one; they and `projector` must outlive the result.
    ScreenOutput(const settings::Settings& settings, ScreenParts parts, const display::Display& projector,
                 MonotonicTime start);
    ~ScreenOutput();
    ScreenOutput(const ScreenOutput&) = delete;
    ScreenOutput& operator=(const ScreenOutput&) = delete;

    void step(const ScreenFrame& frame);
    /// Adds the screen's state to `status`; call once a second.
    void tell(RunStatus& status);

    /// Pictures to keep, as StillTaker.
    void keep_stills(int count, std::optional<Nanoseconds> length);
    void take_still(MonotonicTime now, const tracking::TrackedState& shown, bool settled);
    /// A short run leaves its last picture.
    [[nodiscard]] std::vector<Still> finish_stills(MonotonicTime now, const tracking::TrackedState& shown);

private:
    void open(MonotonicTime now);
    void close(const Error& why);
    void draw(const ScreenFrame& frame);
    void read_back(MonotonicTime now);
    void judge(MonotonicTime now);

    const settings::Settings& settings_;
    ScreenParts parts_;
    const display::Display& projector_;
    MonotonicTime start_;
    scene::StereoLayout layout_;
    std::unique_ptr<display::Display> display_; ///< none: `why_not_`
    DrawRoom draw_room_;
    std::optional<StillTaker> stills_;
    service::WatchdogPolicy watch_;
    service::Health health_ = service::Health::Well;
    std::optional<double> before_ms_;        ///< time that the previous picture took until it was complete
    std::optional<MonotonicTime> presented_; ///< none: not since it was opened, or since sleep
    MonotonicTime tried_;
    bool room_failed_ = false;
    DeviceState why_not_;
    RecentFrameTimes times_;
    status::ScreenReport report_;
};

} // namespace frustumscreen::show
