/// The opening hours, as texts in the settings: "10:00-18:00", "2026-12-25 closed".
///
/// Units    minutes of the local day. A span belongs to the day on which it begins.
/// Errors   nothing for an invalid text.
/// Threads  pure; any.
#pragma once

#include <array>
#include <chrono>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace frustumscreen::settings {

inline constexpr int minutes_a_day = 24 * 60;

struct OpenSpan {
    int from_min = 0;           ///< 0 to less than a day
    int to_min = minutes_a_day; ///< after `from_min`; beyond a day: in the next morning
    [[nodiscard]] bool operator==(const OpenSpan&) const = default;
};
/// "10:00-18:00"; "20:00-02:00" goes on after midnight; "00:00-24:00" is a whole day.
[[nodiscard]] std::optional<OpenSpan> parse_open_span(std::string_view text);
[[nodiscard]] std::string text_of_span(const OpenSpan& span);

/// Replaces the weekday's spans. Several exceptions of one day add up.
struct HoursException {
    std::chrono::sys_days day;    ///< of the local calendar
    std::optional<OpenSpan> open; ///< none: closed all day
    [[nodiscard]] bool operator==(const HoursException&) const = default;
};
/// "2026-12-24 10:00-14:00", "2026-12-25 closed".
[[nodiscard]] std::optional<HoursException> parse_hours_exception(std::string_view text);
[[nodiscard]] std::string text_of_exception(const HoursException& exception);

/// A name of the system's time zones such as "Europe/Berlin"; an empty text is the machine's own. The zone need not
/// exist: that is not checked.
[[nodiscard]] std::optional<std::string> parse_time_zone(std::string_view text);

struct HoursSettings {
    using Day = std::vector<OpenSpan>; ///< empty: closed
    /// From Monday on.
    std::array<Day, 7> weekdays{Day{{}}, Day{{}}, Day{{}}, Day{{}}, Day{{}}, Day{{}}, Day{{}}};
    std::vector<HoursException> exceptions;
    std::string time_zone; ///< empty: the machine's
};

} // namespace frustumscreen::settings
