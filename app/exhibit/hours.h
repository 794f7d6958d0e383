/// The timetable: from a wall clock's time to whether the exhibit is open, and when that changes next.
///
///     Timetable(settings, local_offset_at).at(time) -> open, until
///
/// Zones    only `offset_at` knows them. Where clocks are put forward, a time that there is not is the moment at which they are.
///          Where they are put back, a span lasts from the first second that is not before its opening to the last one that is before
///          its closing: each span of the settings is open once, without a gap.
/// Units    seconds of UTC, as sys_seconds; a local time is written as if it were UTC.
/// Threads  pure; any.
/// Errors   none.
#pragma once

#include "app/settings/hours_settings.h"
#include "firmware_host/base/calendar_day.h"
#include "firmware_host/base/time.h"

#include <chrono>
#include <cstdint>
#include <functional>
#include <optional>

namespace frustumscreen {

/// How far local time is ahead of UTC.
using OffsetAt = std::function<std::chrono::seconds(std::chrono::sys_seconds)>;

struct Opening {
    bool open = true;
    std::optional<std::chrono::sys_seconds> until; ///< none: for `Timetable::farthest` at least
    [[nodiscard]] bool operator==(const Opening&) const = default;
};

/// When local time comes to `local`: for a time that there is twice or not at all, see Zones.
enum class Edge : std::uint8_t { Opens, Closes };
[[nodiscard]] std::chrono::sys_seconds utc_of_local(std::chrono::sys_seconds local, Edge edge,
                                                    const OffsetAt& offset_at);

class Timetable {
public:
    static constexpr std::chrono::days farthest{400};

    Timetable(HoursSettings hours, OffsetAt offset_at);
    [[nodiscard]] Opening at(std::chrono::sys_seconds time) const;
    /// It never closes.
    [[nodiscard]] bool always_open() const { return always_open_; }

private:
    struct Interval {
        std::chrono::sys_seconds from;
        std::chrono::sys_seconds to;
    };
    /// Calls `use(Interval)` for each span that begins on this local day and is not empty.
    void each_interval(std::chrono::sys_days day, const auto& use) const;

    HoursSettings hours_;
    OffsetAt offset_at_;
    bool always_open_;
};

/// Says whether a wall clock can be believed. It is held against the monotonic clock, which nobody sets.
class WallClock {
public:
    /// A smaller step is a clock that is put right.
    static constexpr std::chrono::seconds leap{30};

    /// Returns by how much the clock was set since the look before; 0: it was not.
    std::chrono::seconds look(MonotonicTime now, std::chrono::sys_seconds wall);
    [[nodiscard]] static bool plausible(std::chrono::sys_seconds wall) {
        return wall >= earliest_plausible_day;
    }

private:
    std::optional<std::chrono::sys_seconds>
        began_; ///< of the monotonic clock, by the wall's, at the latest look
};

/// When the exhibit sleeps, from the timetable and from what people do. Dark only comes by a fade; light comes within half a second.
///
/// Closed   it falls asleep when nobody has used the prop for `unused_for`, at the latest `longest_delay` after it could.
/// Woken    a button that is pressed while it is closed keeps it awake for `woken_for` from then.
/// Time     `now` never goes back.
/// Threads  values; one caller. Allocates nothing.
class Sleep {
public:
    static constexpr Nanoseconds woken_for = std::chrono::minutes(10);
    static constexpr Nanoseconds unused_for = std::chrono::minutes(2);
    static constexpr Nanoseconds longest_delay = std::chrono::minutes(15);
    static constexpr Nanoseconds fade_out = std::chrono::seconds(4);
    static constexpr Nanoseconds fade_in = std::chrono::milliseconds(500);

    struct Input {
        bool open = true;
        bool pressed = false;              ///< a button
        std::optional<MonotonicTime> used; ///< when the prop was moved last or a button pressed; none: never
        bool may_sleep = true;             ///< false while the exhibit begins
    };
    void step(MonotonicTime now, const Input& input);

    /// All is dark; what was pressed to end it does nothing else.
    [[nodiscard]] bool asleep() const { return wants_dark_ && share_ <= 0.0; }
    /// Of the picture's light, 0..1.
    [[nodiscard]] double light() const;
    /// It is closed, and a button keeps it awake.
    [[nodiscard]] bool is_woken() const { return woken_until_.has_value(); }

private:
    void move_light(MonotonicTime now);

    bool wants_dark_ = false;
    double share_ = 1.0; ///< of the way from dark to light
    std::optional<MonotonicTime> stepped_;
    std::optional<MonotonicTime> woken_until_;
    std::optional<MonotonicTime> closed_since_; ///< and nothing but use keeps it awake
};

} // namespace frustumscreen
