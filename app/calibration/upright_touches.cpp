#include "app/calibration/upright_touches.h"

#include <algorithm>

namespace frustumscreen::calibration {

std::vector<bool> upright_ones(std::span<const Touch> touches, const glm::dvec3& up) {
    constexpr double within = 0.97; // cosine of 14 degrees
    std::vector<bool> best(touches.size(), false);
    std::ptrdiff_t most = 0;
    for (const Touch& mine : touches) {
        const glm::dvec3 my_up = glm::conjugate(mine.tracker_from_sensor.rotation) * up;
        std::vector<bool> like;
        for (const Touch& other : touches) {
            like.push_back(glm::dot(my_up, glm::conjugate(other.tracker_from_sensor.rotation) * up) > within);
        }
        if (const auto count = std::count(like.begin(), like.end(), true); count > most) {
            most = count;
            best = like;
        }
    }
    return best;
}

} // namespace frustumscreen::calibration
