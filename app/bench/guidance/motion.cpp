#include "app/bench/guidance/motion.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace frustumscreen::bench {

namespace {

constexpr double slide_m_s = 0.25;
constexpr double turn_rad_s = 2.0;
constexpr double walk_m_s = 0.8;
constexpr double stand_up_s = 1.0;
constexpr double begins_and_ends_s = 0.2;

} // namespace

guidance::GuidedState Motion::now() const {
    const double share = lasts_s > 0.0 ? std::min(1.0, gone_s / lasts_s) : 1.0;
    const double eased = share * share * (3.0 - 2.0 * share);
    guidance::GuidedState tracked_state;
    tracked_state.table_from_prop.rotation =
        glm::slerp(from.table_from_prop.rotation, to.table_from_prop.rotation, eased);
    tracked_state.table_from_prop.translation =
        glm::mix(from.table_from_prop.translation, to.table_from_prop.translation, eased);
    const double azimuth = std::atan2(from.eye_m.y, from.eye_m.x);
    const double turn = std::remainder(std::atan2(to.eye_m.y, to.eye_m.x) - azimuth, 2.0 * std::numbers::pi);
    const double radius =
        glm::mix(glm::length(glm::dvec2(from.eye_m)), glm::length(glm::dvec2(to.eye_m)), eased);
    const double at = azimuth + eased * turn;
    tracked_state.eye_m = {radius * std::cos(at), radius * std::sin(at),
                           glm::mix(from.eye_m.z, to.eye_m.z, eased)};
    return tracked_state;
}

double time_for_s(const guidance::Move& move, const guidance::GuidedState& from,
                  const guidance::GuidedState& to) {
    switch (move.action) {
    case guidance::Action::SetDown:
    case guidance::Action::Upright:
        return std::max(stand_up_s, begins_and_ends_s + glm::length(move.by_m) / slide_m_s);
    case guidance::Action::ComeRound: {
        const double angle =
            std::remainder(std::atan2(to.eye_m.y, to.eye_m.x) - std::atan2(from.eye_m.y, from.eye_m.x),
                           2.0 * std::numbers::pi);
        return std::abs(angle) * glm::length(glm::dvec2(from.eye_m)) / walk_m_s;
    }
    case guidance::Action::Turn:
        return begins_and_ends_s + std::abs(move.turn_rad) / turn_rad_s;
    default:
        return begins_and_ends_s + glm::length(move.by_m) / slide_m_s;
    }
}

} // namespace frustumscreen::bench
