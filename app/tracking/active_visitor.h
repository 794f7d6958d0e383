/// The active visitor: chooses the person nearest to the prop.
///
/// Keeps    the active visitor stays until another person has been nearer by `clearly_m` for `dwell`, so two
///          similar persons do not alternate. A person who was not seen for `gone_after` has left.
/// Frame    table T, metres; distances in the table's plane.
/// Time     of the heads, ascending.
/// Threads  one caller. Allocates nothing.
#pragma once

#include "app/tracking/seen_head.h"

#include <array>

namespace frustumscreen::tracking {

class ActiveVisitor {
public:
    static constexpr std::size_t max_people =
        8; ///< remembered persons; a new one replaces the one seen longest ago
    static constexpr double clearly_m = 0.12;
    static constexpr Nanoseconds dwell = std::chrono::milliseconds(700);
    static constexpr Nanoseconds gone_after = std::chrono::milliseconds(500);

    /// Returns whether the active visitor has changed.
    bool see(const SeenHead& head, const glm::dvec3& prop_m);
    /// 0: no person was seen yet.
    [[nodiscard]] std::uint32_t person() const { return person_; }

private:
    std::array<SeenHead, max_people> people_{};
    std::uint32_t person_ = 0;
    std::uint32_t nearer_ = 0; ///< the nearer person
    MonotonicTime nearer_since_;
};

} // namespace frustumscreen::tracking
