/// Which of those at the table the picture turns to: whoever stands nearest to the prop.
///
/// Keeps    the one who has it until somebody else has been nearer by `clearly_m` for `dwell`, so that two who are alike do not take turns;
///          one who has not been seen for `gone_after` has gone.
/// Frame    table T, metres; nearness is on the table's plane.
/// Time     of the heads, ascending.
/// Threads  one caller. Allocates nothing.
#pragma once

#include "app/tracking/seen_head.h"

#include <array>
#include <optional>

namespace frustumscreen {

class Holder {
public:
    static constexpr std::size_t most_people =
        8; ///< who are remembered; the one not seen for longest makes room
    static constexpr double clearly_m = 0.12;
    static constexpr Nanoseconds dwell = std::chrono::milliseconds(700);
    static constexpr Nanoseconds gone_after = std::chrono::milliseconds(500);

    /// Returns whether it is another person than before.
    bool see(const SeenHead& head, const glm::dvec3& prop_m);
    /// 0: nobody was seen yet.
    [[nodiscard]] std::uint32_t person() const { return person_; }

private:
    std::array<SeenHead, most_people> people_{};
    std::uint32_t person_ = 0;
    std::uint32_t nearer_ = 0; ///< person
    MonotonicTime nearer_since_;
};

} // namespace frustumscreen
