/// A visitor's head as a camera sees it, without a marker, and its eye.
///
/// Frame    table T, metres.
/// Threads  values; pure.
#pragma once

#include "firmware_host/base/time.h"

#include <glm/glm.hpp>

#include <cstdint>

namespace frustumscreen::tracking {

struct SeenHead {
    MonotonicTime time;
    std::uint32_t person = 0; ///< one number per head, constant from frame to frame
    glm::dvec3 middle_m{0.0}; ///< of the head with its hair
    double across_sd_m = 0.0; ///< error of the eye across its line to the table, RMS on each axis
};

/// The point between the eyes of a person who looks at a point. A person who looks down turns the head part
/// of the way, and the eyes the rest.
[[nodiscard]] glm::dvec3 eye_of_head(const glm::dvec3& middle_m, const glm::dvec3& looked_at_m);

} // namespace frustumscreen::tracking
