#include "app/programs/frustumscreen/config/week_page.h"

#include "firmware_host/base/calendar_day.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <string_view>
#include <vector>

namespace frustumscreen::programs {

namespace {

constexpr std::array<std::string_view, 7> day_names{"Monday", "Tuesday",  "Wednesday", "Thursday",
                                                    "Friday", "Saturday", "Sunday"};

std::size_t weekday(std::chrono::sys_days day) {
    return std::chrono::weekday(day).iso_encoding() - 1;
}

std::string spans_words(const settings::HoursSettings& hours, std::chrono::sys_days day) {
    std::vector<std::string> spans;
    bool is_exception = false;
    for (const settings::HoursException& exception : hours.exceptions) {
        if (exception.day == day) {
            is_exception = true;
            if (exception.open) {
                spans.push_back(settings::text_of_span(*exception.open));
            }
        }
    }
    if (!is_exception) {
        const settings::HoursSettings::Day& usual = hours.weekdays.at(weekday(day));
        std::transform(usual.begin(), usual.end(), std::back_inserter(spans), settings::text_of_span);
    }
    const std::string words = spans.empty() ? "closed" : fmt::format("{}", fmt::join(spans, ", "));
    return (words == "00:00-24:00" ? "all day" : words) + (is_exception ? ", an exception" : "");
}

std::string moment_words(std::chrono::sys_seconds time, const exhibit::OffsetAt& offset_at) {
    const std::chrono::sys_seconds local = time + offset_at(time);
    const auto day = std::chrono::floor<std::chrono::days>(local);
    const auto minute = std::chrono::duration_cast<std::chrono::minutes>(local - day).count();
    return fmt::format("{} {} {:02}:{:02}", day_names.at(weekday(day)), text_of_day(day), minute / 60,
                       minute % 60);
}

} // namespace

std::string week_page(const settings::HoursSettings& hours, std::chrono::sys_seconds now,
                      const exhibit::OffsetAt& offset_at) {
    const exhibit::Timetable timetable(hours, offset_at);
    std::string page = "This week, by this machine's clock\n";
    if (timetable.always_open()) {
        return page + "  It is awake all day, every day.\n";
    }
    const auto today = std::chrono::floor<std::chrono::days>(now + offset_at(now));
    for (int k = 0; k < 7; ++k) {
        const std::chrono::sys_days day = today + std::chrono::days(k);
        page += fmt::format("  {:<9} {}: {}.\n", day_names.at(weekday(day)), text_of_day(day),
                            spans_words(hours, day));
    }
    const exhibit::Opening opening = timetable.at(now);
    return page +
           (opening.until
                ? fmt::format("  It is {} now; it {} on {}.\n", opening.open ? "awake" : "asleep",
                              opening.open ? "falls asleep" : "wakes",
                              moment_words(*opening.until, offset_at))
                : fmt::format("  It is {} now, for more than a year.\n", opening.open ? "awake" : "asleep"));
}

} // namespace frustumscreen::programs
