#include "app/bench/truth/seeded_situations.h"

#include <cmath>
#include <numbers>

namespace frustumscreen::bench {

settings::Settings cube_in_hand() {
    settings::Settings settings;
    settings.prop = settings::cube_settings(0.10);
    settings.prop.zone = settings::PropZone::Hand;
    settings.table = {0.576, 0.36};
    settings.projector.pinhole = {
        .width = 1280, .height = 800, .fx = 2000.0, .fy = 2000.0, .cx = 640.0, .cy = 400.0};
    settings.projector.table_from_projector.translation.z = 0.9;
    return settings;
}

guidance::GuidedState seeded_situation(const guidance::GuidanceSetup& setup, Seeded& seeded) {
    guidance::GuidedState tracked_state;
    const double azimuth = seeded.between(-std::numbers::pi, std::numbers::pi);
    const double away_m = seeded.between(0.35, 1.2);
    tracked_state.eye_m = {away_m * std::cos(azimuth), away_m * std::sin(azimuth), seeded.between(0.25, 0.9)};
    geometry::RigidTransform& pose = tracked_state.table_from_prop;
    const glm::dvec2 reach = 1.1 * setup.half_table_m;
    pose.translation = {seeded.between(-reach.x, reach.x), seeded.between(-reach.y, reach.y), 0.0};
    if (setup.in_hand) {
        const glm::dquat any(seeded.normal(), seeded.normal(), seeded.normal(), seeded.normal());
        pose.rotation = glm::normalize(any);
        pose.translation.z = seeded.between(0.1, 0.3);
        return tracked_state;
    }
    pose.rotation = glm::angleAxis(seeded.between(-std::numbers::pi, std::numbers::pi), glm::dvec3(0, 0, 1));
    const double share = seeded.between(0.0, 1.0);
    if (share < 0.5) {
        pose.translation.z = seeded.between(0.0, 0.2);
    }
    if (share < 0.25) {
        const double axis = seeded.between(-std::numbers::pi, std::numbers::pi);
        pose.rotation = pose.rotation * glm::angleAxis(seeded.between(0.0, std::numbers::pi),
                                                       glm::dvec3(std::cos(axis), std::sin(axis), 0.0));
    }
    return tracked_state;
}

guidance::Execution seeded_person(const guidance::Move& move, const guidance::GuidanceSetup& setup,
                                  Seeded& seeded) {
    const double off_rad = guidance::sloppy_direction_deg * std::numbers::pi / 180.0;
    const bool vertical = move.action == guidance::Action::Raise || move.action == guidance::Action::Lower;
    guidance::Execution execution;
    execution.amount = seeded.between(1.0 - guidance::sloppy_amount, 1.0 + guidance::sloppy_amount);
    execution.aside_rad =
        vertical ? seeded.between(-std::numbers::pi, std::numbers::pi) : seeded.between(-off_rad, off_rad);
    execution.raised_rad = setup.in_hand ? seeded.between(-off_rad, off_rad) : 0.0;
    execution.about_origin = seeded.between(0.0, 1.0) < 0.5;
    return execution;
}

} // namespace frustumscreen::bench
