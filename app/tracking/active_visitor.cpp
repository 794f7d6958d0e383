#include "app/tracking/active_visitor.h"

#include <algorithm>

namespace frustumscreen::tracking {

bool ActiveVisitor::see(const SeenHead& head, const glm::dvec3& prop_m) {
    const auto same = std::find_if(people_.begin(), people_.end(),
                                   [&](const SeenHead& one) { return one.person == head.person; });
    const auto oldest = std::min_element(
        people_.begin(), people_.end(), [](const SeenHead& a, const SeenHead& b) { return a.time < b.time; });
    (same != people_.end() ? *same : *oldest) = head;

    const auto is_there = [&head](const SeenHead& one) {
        return one.person != 0 && head.time - one.time <= gone_after;
    };
    const auto away_m = [&prop_m](const SeenHead& one) {
        return glm::distance(glm::dvec2(one.middle_m), glm::dvec2(prop_m));
    };
    const SeenHead* nearest = &head;
    const SeenHead* now = nullptr;
    for (const SeenHead& one : people_) {
        nearest = is_there(one) && away_m(one) < away_m(*nearest) ? &one : nearest;
        now = is_there(one) && one.person == person_ ? &one : now;
    }
    if (now != nullptr && away_m(*nearest) + clearly_m >= away_m(*now)) {
        nearer_ = 0;
        return false;
    }
    if (now != nullptr && nearest->person != nearer_) {
        nearer_ = nearest->person;
        nearer_since_ = head.time;
    }
    if (now != nullptr && head.time - nearer_since_ < dwell) {
        return false;
    }
    nearer_ = 0;
    person_ = nearest->person;
    return true;
}

} // namespace frustumscreen::tracking
