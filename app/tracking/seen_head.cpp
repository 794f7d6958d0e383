#include "app/tracking/seen_head.h"

#include <cmath>

namespace frustumscreen::tracking {

namespace {

constexpr double head_turns = 0.6; ///< share of the downward angle that the head turns
constexpr double ahead_m = 0.08;   ///< of the eyes from the middle of head and hair, in the head's axes
constexpr double down_m = 0.024;

} // namespace

glm::dvec3 eye_of_head(const glm::dvec3& middle_m, const glm::dvec3& looked_at_m) {
    const glm::dvec2 across(looked_at_m - middle_m);
    const double away = glm::length(across);
    const glm::dvec2 facing = away > 1e-6 ? across / away : glm::dvec2(0.0, 1.0);
    const double pitch = head_turns * std::atan2(middle_m.z - looked_at_m.z, away);
    const glm::dvec3 ahead(std::cos(pitch) * facing, -std::sin(pitch));
    const glm::dvec3 down(-std::sin(pitch) * facing, -std::cos(pitch));
    return middle_m + ahead_m * ahead + down_m * down;
}

} // namespace frustumscreen::tracking
