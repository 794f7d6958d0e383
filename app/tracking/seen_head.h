/// A visitor's head as a camera sees it, with nothing on it, and the eye that belongs to it.
///
/// Frame    table T, metres.
/// Threads  values; pure.
#pragma once

#include "firmware_host/base/time.h"

#include <glm/glm.hpp>

#include <cstdint>

namespace frustumscreen {

struct SeenHead {
    MonotonicTime time;
    std::uint32_t person = 0; ///< the same head has the same number from frame to frame
    glm::dvec3 middle_m{0.0}; ///< of the head with its hair
    double across_sd_m = 0.0; ///< how far the eye may be off across its line to the table, RMS on each axis
};

/// The point between the eyes of somebody who looks at a point. Whoever looks down turns the head by a part of the way, and the eyes
/// by the rest.
[[nodiscard]] glm::dvec3 eye_of_head(const glm::dvec3& middle_m, const glm::dvec3& looked_at_m);

} // namespace frustumscreen
