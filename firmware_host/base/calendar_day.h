/// Conversion between a day of the Gregorian calendar and its ISO 8601 text, "2030-12-31".
///
/// Threads  pure; any.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <chrono>
#include <optional>
#include <string>
#include <string_view>

namespace frustumscreen {

/// A correct clock, and any signature, is no older than this program.
inline constexpr std::chrono::sys_days earliest_plausible_day = std::chrono::year(2026) / 1 / 1;

[[nodiscard]] inline std::string text_of_day(std::chrono::sys_days day) {
    const std::chrono::year_month_day date(day);
    return fmt::format("{:04}-{:02}-{:02}", static_cast<int>(date.year()),
                       static_cast<unsigned>(date.month()), static_cast<unsigned>(date.day()));
}

/// nullopt unless the text has exactly this form and names an existing day.
[[nodiscard]] inline std::optional<std::chrono::sys_days> parse_day(std::string_view text) {
    constexpr std::string_view form = "0000-00-00";
    const auto fits = [](char c, char place) { return place == '-' ? c == '-' : c >= '0' && c <= '9'; };
    if (text.size() != form.size() || !std::equal(text.begin(), text.end(), form.begin(), fits)) {
        return std::nullopt;
    }
    const auto number = [text](std::size_t from, std::size_t digits) {
        unsigned value = 0;
        std::from_chars(text.data() + from, text.data() + from + digits, value);
        return value;
    };
    const std::chrono::year_month_day date(std::chrono::year(static_cast<int>(number(0, 4))),
                                           std::chrono::month(number(5, 2)), std::chrono::day(number(8, 2)));
    return date.ok() ? std::optional(std::chrono::sys_days(date)) : std::nullopt;
}

} // namespace frustumscreen
