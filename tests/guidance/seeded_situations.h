/// Situations from a seed: a frustum on a table as visitors leave it, a cube in a hand, and any other convex prop.
#pragma once

#include "app/guidance/advise.h"
#include "app/settings/lit_zone.h"
#include "app/settings/settings.h"

#include <cmath>
#include <numbers>
#include <random>

namespace frustumscreen {

class Seeded {
public:
    explicit Seeded(std::uint64_t seed) : generator_(seed) {}
    double between(double low, double high) { return low + (high - low) * share_(generator_); }
    double normal() { return normal_(generator_); }

private:
    std::mt19937_64 generator_;
    std::uniform_real_distribution<double> share_{0.0, 1.0};
    std::normal_distribution<double> normal_;
};

inline GuidanceSetup setup_of(const Settings& settings) {
    GuidanceSetup setup;
    setup.prop = make_prop(settings.prop);
    setup.projector = settings.projector.pinhole;
    setup.table_from_projector = settings.projector.table_from_projector;
    setup.least_sine_of_light = least_sine_of_light;
    setup.in_hand = settings.prop.zone == PropZone::Hand;
    setup.half_table_m = 0.5 * glm::dvec2(settings.table.width_m, settings.table.depth_m);
    return setup;
}

/// config/cube.toml: a small cube under a projector that hangs lower.
inline GuidanceSetup cube_in_hand() {
    Settings settings;
    settings.prop = cube_settings(0.10);
    settings.prop.zone = PropZone::Hand;
    settings.table = {0.576, 0.36};
    settings.projector.pinhole = {1280, 800, 2000.0, 2000.0, 640.0, 400.0};
    settings.projector.table_from_projector.translation.z = 0.9;
    return setup_of(settings);
}

inline GuidanceSetup frustum_on_table() {
    return setup_of(Settings{});
}

/// A wedge: no two of its sides are alike.
inline GuidanceSetup wedge_on_table() {
    GuidanceSetup setup = frustum_on_table();
    PropShape& prop = setup.prop;
    const glm::dmat4 shear(glm::dvec4(0.6, 0.0, 0.0, 0.0), glm::dvec4(0.1, 0.7, 0.0, 0.0),
                           glm::dvec4(0.15, -0.1, 0.9, 0.0), glm::dvec4(0.0, 0.0, 0.0, 1.0));
    const auto moved = [&](const glm::dvec3& p) { return glm::dvec3(shear * glm::dvec4(p, 1.0)); };
    for (glm::dvec3& corner : prop.corners) {
        corner = moved(corner);
    }
    prop.middle = moved(prop.middle);
    for (PropFace& face : prop.faces) {
        for (glm::dvec3& corner : face.corners) {
            corner = moved(corner);
        }
        const auto& c = face.corners;
        const glm::dvec3 normal = glm::normalize(glm::cross(c[1] - c[0], c[2] - c[0]));
        face.plane = {normal, glm::dot(normal, c[0])};
    }
    return setup;
}

inline GuidedSituation situation_of(const GuidanceSetup& setup, Seeded& seeded) {
    GuidedSituation situation;
    const double azimuth = seeded.between(-std::numbers::pi, std::numbers::pi);
    const double away_m = seeded.between(0.35, 1.2);
    situation.eye_m = {away_m * std::cos(azimuth), away_m * std::sin(azimuth), seeded.between(0.25, 0.9)};
    RigidTransform& pose = situation.table_from_prop;
    const glm::dvec2 reach = 1.1 * setup.half_table_m;
    pose.translation = {seeded.between(-reach.x, reach.x), seeded.between(-reach.y, reach.y), 0.0};
    if (setup.in_hand) {
        const glm::dquat any(seeded.normal(), seeded.normal(), seeded.normal(), seeded.normal());
        pose.rotation = glm::normalize(any);
        pose.translation.z = seeded.between(0.1, 0.3);
        return situation;
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
    return situation;
}

/// As a person may carry it out: direction within 20 degrees, amount within 40 per cent.
inline Execution person(const Move& move, const GuidanceSetup& setup, Seeded& seeded) {
    const double off_rad = sloppy_direction_deg * std::numbers::pi / 180.0;
    const bool vertical = move.action == Action::Raise || move.action == Action::Lower;
    Execution execution;
    execution.amount = seeded.between(1.0 - sloppy_amount, 1.0 + sloppy_amount);
    execution.aside_rad =
        vertical ? seeded.between(-std::numbers::pi, std::numbers::pi) : seeded.between(-off_rad, off_rad);
    execution.raised_rad = setup.in_hand ? seeded.between(-off_rad, off_rad) : 0.0;
    execution.about_origin = seeded.between(0.0, 1.0) < 0.5;
    return execution;
}

} // namespace frustumscreen
