/// Scales a duration.
#pragma once

#include "firmware_host/base/time.h"

#include <algorithm>
#include <cmath>

namespace frustumscreen::tracker {

/// `length` times `factor`, limited to 146 years either way, so a recording's end can be added to its
/// beginning.
[[nodiscard]] inline Nanoseconds scaled(Nanoseconds length, double factor) {
    constexpr double most = 4611686018427387904.0; // 2^62
    return Nanoseconds(std::llround(std::clamp(static_cast<double>(length.count()) * factor, -most, most)));
}

} // namespace frustumscreen::tracker
