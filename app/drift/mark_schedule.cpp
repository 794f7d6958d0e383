#include "app/drift/mark_schedule.h"

#include <algorithm>

namespace frustumscreen::drift {

std::optional<MarkTimes::Moment> MarkTimes::moment(Nanoseconds since_begin, std::size_t marks) {
    if (since_begin < lead) { // no mark was lit before
        return since_begin >= Nanoseconds::zero() ? std::optional(Moment{0, MarkPhase::Before})
                                                  : std::nullopt;
    }
    const Nanoseconds from_first = since_begin - lead;
    const auto mark = static_cast<std::size_t>(from_first / each);
    const Nanoseconds since_lit = from_first % each;
    if (mark >= marks) {
        return std::nullopt;
    }
    if (since_lit >= settles && since_lit < lit) {
        return Moment{mark, MarkPhase::Lit};
    }
    return since_lit >= lit + settles ? std::optional(Moment{mark, MarkPhase::After}) : std::nullopt;
}

double MarkTimes::brightness(Nanoseconds since_lit) {
    if (since_lit < Nanoseconds::zero() || since_lit >= lit) {
        return 0.0;
    }
    const Nanoseconds to_end = std::min(since_lit, lit - since_lit);
    return std::min(1.0, to_seconds(to_end) / to_seconds(fade));
}

std::optional<MarkSchedule::Mark> MarkSchedule::step(MonotonicTime now, bool quiet) {
    const bool goes_on = began_ && now - *began_ < MarkTimes::length(marks_);
    if (!quiet) {
        quiet_since_.reset();
        if (goes_on) {
            began_.reset();
        }
        return std::nullopt;
    }
    quiet_since_ = quiet_since_.value_or(now);
    if (!goes_on) {
        if (marks_ == 0 || now - *quiet_since_ < quiet_before || (next_ && now < *next_)) {
            return std::nullopt;
        }
        began_ = now;
        next_ = now + between_sets;
    }
    const Nanoseconds from_first = now - *began_ - MarkTimes::lead;
    if (from_first < Nanoseconds::zero()) {
        return std::nullopt;
    }
    const double brightness = MarkTimes::brightness(from_first % MarkTimes::each);
    return brightness > 0.0
               ? std::optional(Mark{static_cast<std::size_t>(from_first / MarkTimes::each), brightness})
               : std::nullopt;
}

} // namespace frustumscreen::drift
