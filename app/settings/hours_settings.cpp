#include "app/settings/hours_settings.h"

#include "firmware_host/base/calendar_day.h"

#include <algorithm>

namespace frustumscreen::settings {

namespace {

constexpr std::string_view closed = "closed";
constexpr std::size_t longest_zone = 64;

/// "07:30" or "7:30" as minutes; nothing if the form is wrong, or the time is after "24:00".
std::optional<int> parse_minute(std::string_view written) {
    constexpr std::string_view form = "00:00";
    const std::string text = (written.size() + 1 == form.size() ? "0" : "") + std::string(written);
    const auto fits = [](char c, char place) { return place == ':' ? c == ':' : c >= '0' && c <= '9'; };
    if (text.size() != form.size() || !std::equal(text.begin(), text.end(), form.begin(), fits)) {
        return std::nullopt;
    }
    const auto number = [&text](std::size_t at) { return 10 * (text[at] - '0') + (text[at + 1] - '0'); };
    const int minute = 60 * number(0) + number(3);
    return number(3) < 60 && minute <= minutes_a_day ? std::optional(minute) : std::nullopt;
}

std::string text_of_minute(int minute) {
    return fmt::format("{:02}:{:02}", minute / 60, minute % 60);
}

} // namespace

std::optional<OpenSpan> parse_open_span(std::string_view text) {
    const std::size_t dash = text.find('-');
    if (dash == std::string_view::npos) {
        return std::nullopt;
    }
    const std::optional<int> from = parse_minute(text.substr(0, dash));
    const std::optional<int> to = parse_minute(text.substr(dash + 1));
    // Two equal times may mean a whole day or nothing.
    if (!from || !to || *from == minutes_a_day || *from == *to) {
        return std::nullopt;
    }
    return OpenSpan{*from, *to > *from ? *to : *to + minutes_a_day};
}

std::string text_of_span(const OpenSpan& span) {
    const int to = span.to_min > minutes_a_day ? span.to_min - minutes_a_day : span.to_min;
    return fmt::format("{}-{}", text_of_minute(span.from_min), text_of_minute(to));
}

std::optional<HoursException> parse_hours_exception(std::string_view text) {
    const std::size_t space = text.find(' ');
    if (space == std::string_view::npos) {
        return std::nullopt;
    }
    const std::optional<std::chrono::sys_days> day = parse_day(text.substr(0, space));
    const std::string_view hours = text.substr(space + 1);
    const std::optional<OpenSpan> span = parse_open_span(hours);
    return day && (span || hours == closed) ? std::optional(HoursException{*day, span}) : std::nullopt;
}

std::string text_of_exception(const HoursException& exception) {
    return fmt::format("{} {}", text_of_day(exception.day),
                       exception.open ? text_of_span(*exception.open) : std::string(closed));
}

std::optional<std::string> parse_time_zone(std::string_view text) {
    const auto fits = [](char c) {
        return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
               c == '+' || c == '-' || c == '/';
    };
    const bool is_name =
        text.size() <= longest_zone && std::all_of(text.begin(), text.end(), fits) && !text.starts_with('/');
    return is_name ? std::optional(std::string(text)) : std::nullopt;
}

} // namespace frustumscreen::settings
