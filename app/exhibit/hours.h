/// The timetable: from the wall clock's time to whether the exhibit is open and when that changes next.
///
///     Timetable(settings, local_offset_at).at(time) -> open, until
///
/// Zones    only `offset_at` knows them. Where clocks are put forward, a skipped local time counts as the moment of
///          the change. Where they are put back, a span lasts from the first second not before its opening to the
///          last second before its closing: each span of the settings is open once, without a gap.
/// Units    seconds of UTC, as sys_seconds; a local time is stored as if it were UTC.
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

namespace frustumscreen::exhibit {

/// The lead of local time over UTC.
using OffsetAt = std::function<std::chrono::seconds(std::chrono::sys_seconds)>;

struct Opening {
    bool open = true;
    std::optional<std::chrono::sys_seconds> until; ///< none: no change for at least `Timetable::farthest`
    [[nodiscard]] bool operator==(const Opening&) const = default;
};

/// The time when local time reaches `local`. Repeated and skipped local times: see Zones.
enum class Edge : std::uint8_t { Opens, Closes };
[[nodiscard]] std::chrono::sys_seconds utc_of_local(std::chrono::sys_seconds local, Edge edge,
                                                    const OffsetAt& offset_at);

class Timetable {
public:
    static constexpr std::chrono::days farthest{400};

    Timetable(settings::HoursSettings hours, OffsetAt offset_at);
    [[nodiscard]] Opening at(std::chrono::sys_seconds time) const;
    /// True if the exhibit never closes.
    [[nodiscard]] bool always_open() const { return always_open_; }

private:
    struct Interval {
        std::chrono::sys_seconds from;
        std::chrono::sys_seconds to;
    };
    /// Calls `use(Interval)` for each span that begins on this local day and is not empty.
    void each_interval(std::chrono::sys_days day, const auto& use) const;

    settings::HoursSettings hours_;
    OffsetAt offset_at_;
    bool always_open_;
};

/// Judges whether a wall clock is plausible, by comparison with the monotonic clock, which cannot be set.
class WallClock {
public:
    /// A smaller step is a correction of the clock.
    static constexpr std::chrono::seconds leap{30};

    /// Returns the amount by which the clock was set since the previous call; 0: it was not set.
    std::chrono::seconds look(MonotonicTime now, std::chrono::sys_seconds wall);
    [[nodiscard]] static bool plausible(std::chrono::sys_seconds wall) {
        return wall >= earliest_plausible_day;
    }

private:
    std::optional<std::chrono::sys_seconds>
        began_; ///< when the monotonic clock began, in wall time, as of the latest call
};

/// When the exhibit sleeps, from the timetable and from its use. It fades to dark slowly and becomes bright within
/// half a second.
///
/// Closed   falls asleep when the prop has not been used for `unused_for`, at most `longest_delay` after closing.
/// Woken    a button pressed while closed keeps it awake for `woken_for` from then.
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
        std::optional<MonotonicTime> used; ///< when the prop last moved or a button was pressed; none: never
        bool may_sleep = true;             ///< false while the exhibit starts
    };
    void step(MonotonicTime now, const Input& input);

    /// True if everything is dark; the press that ends this has no other effect.
    [[nodiscard]] bool asleep() const { return wants_dark_ && share_ <= 0.0; }
    /// The factor on the picture's light, 0..1.
    [[nodiscard]] double light() const;
    /// True if it is closed and a button keeps it awake.
    [[nodiscard]] bool is_woken() const { return woken_until_.has_value(); }

private:
    void move_light(MonotonicTime now);

    bool wants_dark_ = false;
    double share_ = 1.0; ///< from dark to light
    std::optional<MonotonicTime> stepped_;
    std::optional<MonotonicTime> woken_until_;
    std::optional<MonotonicTime> closed_since_; ///< from then on only use keeps it awake
};

} // namespace frustumscreen::exhibit
