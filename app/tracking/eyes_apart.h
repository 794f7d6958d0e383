/// How far apart the picture's two eyes are, as a share of the interocular distance. It changes smoothly between one
/// eye and two.
///
/// Way      a smooth step of `each_way`; if the wish changes on the way, it turns round without a jump. It ends at
///          exactly 0 or 1, so that a picture at rest is not drawn again.
/// Time     of the pictures; a decreasing time moves nothing. The rhythm of the pictures matters only at a change.
/// Threads  a value; one caller. Allocates nothing.
#pragma once

#include "firmware_host/base/time.h"

#include <optional>

namespace frustumscreen::tracking {

class EyesApart {
public:
    static constexpr Nanoseconds each_way = std::chrono::milliseconds(500);

    /// `both`: whether there are two eyes at first.
    explicit EyesApart(bool both) : way_(both ? 1.0 : 0.0) {}

    /// The share at `time`, 0..1, while both eyes are wanted or one.
    [[nodiscard]] double follow(MonotonicTime time, bool both);

private:
    double way_; ///< 0: one eye; 1: both; linear in time
    std::optional<MonotonicTime> last_;
};

} // namespace frustumscreen::tracking
