#include "app/tracking/level_head.h"

#include <cmath>

namespace frustumscreen::tracking {

glm::dquat level_head(const glm::dvec3& eye_m, const glm::dvec3& looked_at_m) {
    constexpr double straight_above_m = 1e-9;
    const glm::dvec2 ahead(looked_at_m - eye_m);
    if (!(glm::length(ahead) > straight_above_m)) {
        return {1.0, 0.0, 0.0, 0.0};
    }
    return glm::angleAxis(std::atan2(-ahead.x, ahead.y), glm::dvec3(0.0, 0.0, 1.0));
}

} // namespace frustumscreen::tracking
