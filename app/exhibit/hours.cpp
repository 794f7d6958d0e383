#include "app/exhibit/hours.h"

#include "app/geometry/time_curves.h"

#include <algorithm>
#include <utility>

namespace frustumscreen::exhibit {

namespace {

using std::chrono::days;
using std::chrono::minutes;
using std::chrono::seconds;
using std::chrono::sys_days;
using std::chrono::sys_seconds;

/// Largest offset of a time zone from UTC.
constexpr std::chrono::hours farthest_zone{15};

/// The first second in (low, high] whose offset differs from that at `low`.
sys_seconds change_of_offset(sys_seconds low, sys_seconds high, const OffsetAt& offset_at) {
    const seconds before = offset_at(low);
    while (high - low > seconds(1)) {
        const sys_seconds middle = low + (high - low) / 2;
        (offset_at(middle) == before ? low : high) = middle;
    }
    return high;
}

bool is_whole_day(const settings::HoursSettings::Day& day) {
    return std::any_of(day.begin(), day.end(), [](const settings::OpenSpan& span) {
        return span.from_min == 0 && span.to_min >= settings::minutes_a_day;
    });
}

} // namespace

sys_seconds utc_of_local(sys_seconds local, Edge edge, const OffsetAt& offset_at) {
    const sys_seconds low = local - farthest_zone;
    const sys_seconds high = local + farthest_zone;
    const seconds before = offset_at(low);
    const seconds after = offset_at(high);
    if (before == after) {
        return local - before;
    }
    const sys_seconds change = change_of_offset(low, high, offset_at);
    const sys_seconds by_before = local - before;
    const sys_seconds by_after = local - after;
    return edge == Edge::Opens ? (by_before < change ? by_before : std::max(change, by_after))
                               : (by_after > change ? by_after : std::min(change, by_before));
}

Timetable::Timetable(settings::HoursSettings hours, OffsetAt offset_at)
    : hours_(std::move(hours)), offset_at_(std::move(offset_at)),
      always_open_(hours_.exceptions.empty() &&
                   std::all_of(hours_.weekdays.begin(), hours_.weekdays.end(), is_whole_day)) {}

void Timetable::each_interval(sys_days day, const auto& use) const {
    const auto use_span = [&](const settings::OpenSpan& span) {
        const Interval interval{utc_of_local(day + minutes(span.from_min), Edge::Opens, offset_at_),
                                utc_of_local(day + minutes(span.to_min), Edge::Closes, offset_at_)};
        if (interval.from < interval.to) {
            use(interval);
        }
    };
    bool excepted = false;
    for (const settings::HoursException& exception : hours_.exceptions) {
        if (exception.day == day) {
            excepted = true;
            if (exception.open) {
                use_span(*exception.open);
            }
        }
    }
    if (!excepted) {
        const unsigned weekday = std::chrono::weekday(day).iso_encoding() - 1;
        std::for_each(hours_.weekdays.at(weekday).begin(), hours_.weekdays.at(weekday).end(), use_span);
    }
}

Opening Timetable::at(sys_seconds time) const {
    if (always_open_) {
        return {true, std::nullopt};
    }
    const sys_days today = std::chrono::floor<days>(time + offset_at_(time));
    std::optional<sys_seconds> closes; ///< of the span that is open at `time`
    std::optional<sys_seconds> opens;  ///< the next one after `time`
    // A span may have begun the day before, or two days before if the date line moved.
    for (sys_days day = today - days(2); day <= today + farthest; day += days(1)) {
        const std::optional<sys_seconds> closed_before = closes;
        // Spans of one day are in any order, and may touch each other.
        for (std::size_t pass = 0; pass < 8; ++pass) {
            const std::optional<sys_seconds> before = closes;
            each_interval(day, [&](const Interval& each) {
                if (each.from <= time && each.to > time) {
                    closes = std::max(closes.value_or(each.to), each.to);
                } else if (closes && each.from <= *closes && each.to > *closes) {
                    closes = each.to;
                } else if (each.from > time) {
                    opens = std::min(opens.value_or(each.from), each.from);
                }
            });
            if (closes == before) {
                break;
            }
        }
        const bool is_over = day > today + days(1);
        if (is_over && closes && closes == closed_before) {
            return {true, closes};
        }
        if (is_over && !closes && opens) {
            return {false, opens};
        }
    }
    return {closes.has_value(), std::nullopt};
}

seconds WallClock::look(MonotonicTime now, sys_seconds wall) {
    const auto since_boot = std::chrono::duration_cast<seconds>(now.time_since_epoch());
    const sys_seconds began = wall - since_boot;
    const seconds set = began - std::exchange(began_, began).value_or(began);
    return std::chrono::abs(set) > leap ? set : seconds(0);
}

void Sleep::step(MonotonicTime now, const Input& input) {
    if (input.open) {
        woken_until_.reset();
    } else if (input.pressed) {
        woken_until_ = now + woken_for;
    }
    if (woken_until_ && now >= *woken_until_) {
        woken_until_.reset();
    }
    if (input.open || woken_until_ || !input.may_sleep) {
        closed_since_.reset();
        wants_dark_ = false;
    } else {
        closed_since_ = closed_since_ ? closed_since_ : now;
        const bool is_used = input.used && now - *input.used < unused_for;
        wants_dark_ = asleep() || !is_used || now - *closed_since_ >= longest_delay;
    }
    move_light(now);
}

void Sleep::move_light(MonotonicTime now) {
    const double elapsed_s = to_seconds(now - stepped_.value_or(now));
    stepped_ = now;
    const double way = wants_dark_ ? -elapsed_s / to_seconds(fade_out) : elapsed_s / to_seconds(fade_in);
    share_ = std::clamp(share_ + way, 0.0, 1.0);
}

double Sleep::light() const {
    return geometry::ease(share_);
}

} // namespace frustumscreen::exhibit
