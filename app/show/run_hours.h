/// The exhibit's hours in a run: the timetable, the wall clock and the exhibit's use, as one factor on the light, 0
/// to 1.
///
/// Clock    if the wall clock was never set, the exhibit stays awake. Setting it shifts only the timetable;
///          everything else runs by the monotonic clock.
/// Time     two parameters: the monotonic `now`, and the wall clock.
/// Threads  the render thread. Allocates only where the timetable is evaluated: once a minute and at its changes.
/// Errors   none; the status has a sentence about them.
#pragma once

#include "app/exhibit/hours.h"
#include "app/show/run_report.h"

#include <chrono>
#include <optional>

namespace frustumscreen::show {

class RunHours {
public:
    /// `missing_zone`: the settings' time zone if this machine does not have it; else empty.
    RunHours(const settings::HoursSettings& settings, exhibit::OffsetAt offset_at,
             std::string_view missing_zone);

    struct Input {
        std::chrono::system_clock::time_point wall;
        bool pressed = false;
        std::optional<MonotonicTime> used; ///< as Sleep
        bool may_sleep = true;
    };
    void step(MonotonicTime now, const Input& input);

    [[nodiscard]] bool asleep() const { return sleep_.asleep(); }
    /// The factor on the picture's light, 0..1.
    [[nodiscard]] double light() const { return sleep_.light(); }
    /// The sentence changes only with the state, not with the time.
    [[nodiscard]] status::HoursStatus status() const;

private:
    void look_at_clock(MonotonicTime now, std::chrono::sys_seconds wall);
    [[nodiscard]] bool is_open() const { return !plausible_ || opening_.open; }

    exhibit::Timetable timetable_;
    exhibit::WallClock clock_;
    exhibit::Sleep sleep_;
    exhibit::Opening opening_;
    std::optional<std::chrono::sys_seconds> looked_; ///< at the timetable
    std::chrono::sys_seconds wall_{};
    bool plausible_ = true;
    Sentence zone_missing_;
    Sentence clock_set_;
};

} // namespace frustumscreen::show
