/// The exhibit's hours in a run: the timetable, the wall clock and what people do, as one light from 0 to 1.
///
/// Clock    one that was never set tells no hours: the exhibit stays awake. One that is set shifts the timetable and nothing else,
///          which runs by the monotonic clock.
/// Time     two parameters: the monotonic `now`, and the wall clock.
/// Threads  the render thread. Allocates nothing, but where the timetable is asked, once a minute and at its changes.
/// Errors   none; the status has a sentence.
#pragma once

#include "app/exhibit/hours.h"
#include "app/show/run_report.h"

#include <chrono>
#include <optional>

namespace frustumscreen {

class RunHours {
public:
    /// `missing_zone`: of the settings, where this machine has none of that name; empty: it has it.
    RunHours(const HoursSettings& settings, OffsetAt offset_at, std::string_view missing_zone);

    struct Input {
        std::chrono::system_clock::time_point wall;
        bool pressed = false;
        std::optional<MonotonicTime> used; ///< as Sleep
        bool may_sleep = true;
    };
    void step(MonotonicTime now, const Input& input);

    [[nodiscard]] bool asleep() const { return sleep_.asleep(); }
    /// Of the picture's light, 0..1.
    [[nodiscard]] double light() const { return sleep_.light(); }
    /// Its sentence changes with what is the case, not with the time.
    [[nodiscard]] HoursStatus status() const;

private:
    void look_at_clock(MonotonicTime now, std::chrono::sys_seconds wall);
    [[nodiscard]] bool is_open() const { return !plausible_ || opening_.open; }

    Timetable timetable_;
    WallClock clock_;
    Sleep sleep_;
    Opening opening_;
    std::optional<std::chrono::sys_seconds> looked_; ///< at the timetable
    std::chrono::sys_seconds wall_{};
    bool plausible_ = true;
    Sentence zone_missing_;
    Sentence clock_set_;
};

} // namespace frustumscreen
