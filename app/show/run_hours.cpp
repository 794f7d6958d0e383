#include "app/show/run_hours.h"

#include "firmware_host/base/format_sentence.h"
#include "firmware_host/base/local_time.h"

#include <fmt/chrono.h>

namespace frustumscreen::show {

namespace {

/// The timetable is also evaluated at this interval, because another program may have set the time zone.
constexpr std::chrono::minutes between_looks{1};

/// Local time, as "Mon 2026-11-23 18:00".
Sentence words_of(std::chrono::sys_seconds time) {
    const std::chrono::sys_seconds local = time + local_offset_at(time);
    return format_sentence("{:%a %F %H:%M}", fmt::gmtime(std::chrono::system_clock::to_time_t(local)));
}

} // namespace

RunHours::RunHours(const settings::HoursSettings& settings, exhibit::OffsetAt offset_at,
                   std::string_view missing_zone)
    : timetable_(settings, std::move(offset_at)),
      zone_missing_(missing_zone.empty()
                        ? Sentence()
                        : format_sentence(
                              "; this machine has no time zone \"{}\" of hours.time_zone, so its own is used",
                              missing_zone)) {}

void RunHours::look_at_clock(MonotonicTime now, std::chrono::sys_seconds wall) {
    wall_ = wall;
    if (const std::chrono::seconds set = clock_.look(now, wall); set.count() != 0) {
        clock_set_ =
            format_sentence("the clock was set {} by {} s, to {}", set.count() > 0 ? "forward" : "back",
                            std::chrono::abs(set).count(), words_of(wall).view());
        looked_.reset();
    }
    plausible_ = exhibit::WallClock::plausible(wall);
    const bool is_due = !looked_ || wall < *looked_ || wall >= *looked_ + between_looks ||
                        (opening_.until && wall >= *opening_.until);
    if (plausible_ && is_due) {
        opening_ = timetable_.at(wall);
        looked_ = wall;
    }
}

void RunHours::step(MonotonicTime now, const Input& input) {
    if (timetable_.always_open()) {
        return;
    }
    const auto wall = std::chrono::floor<std::chrono::seconds>(input.wall);
    if (wall != wall_) {
        look_at_clock(now, wall);
    }
    sleep_.step(
        now, {.open = is_open(), .pressed = input.pressed, .used = input.used, .may_sleep = input.may_sleep});
}

status::HoursStatus RunHours::status() const {
    if (timetable_.always_open()) {
        return {};
    }
    status::HoursStatus status{.state = plausible_ ? opening_.open ? "open" : "closed" : "clock_wrong",
                               .until = plausible_ ? opening_.until : std::nullopt,
                               .why = {},
                               .clock = clock_set_,
                               .asleep = sleep_.asleep()};
    if (!plausible_) {
        const std::chrono::year_month_day day(std::chrono::floor<std::chrono::days>(wall_));
        status.why = format_sentence(
            "awake: by the machine's clock it is the year {}, so it was never set; set it with "
            "timedatectl, or give the machine a new battery",
            static_cast<int>(day.year()));
        return status;
    }
    const Sentence until =
        opening_.until ? format_sentence(" until {}", words_of(*opening_.until).view()) : Sentence();
    if (opening_.open) {
        status.why = format_sentence("awake: open{}{}", until.view(), zone_missing_.view());
    } else if (sleep_.asleep()) {
        status.why = format_sentence("asleep: closed{}; any button wakes it for ten minutes{}", until.view(),
                                     zone_missing_.view());
    } else if (sleep_.is_woken()) {
        status.why = format_sentence(
            "awake: closed{}, but a button was pressed; it sleeps ten minutes after the latest press{}",
            until.view(), zone_missing_.view());
    } else {
        status.why = format_sentence("awake: closed{}; it sleeps when the prop has not been used for two "
                                     "minutes, after fifteen at the latest{}",
                                     until.view(), zone_missing_.view());
    }
    return status;
}

} // namespace frustumscreen::show
