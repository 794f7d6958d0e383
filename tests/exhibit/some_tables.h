/// Random tables, props and projectors from a seed.
#pragma once

#include "app/exhibit/table_layout.h"

#include <cmath>
#include <random>

namespace frustumscreen::exhibit {

inline double between(std::mt19937_64& random, double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
}

inline geometry::RigidTransform standing(const glm::dvec2& place, double yaw) {
    return {glm::angleAxis(yaw, glm::dvec3(0, 0, 1)), glm::dvec3(place, 0.0)};
}

/// Any table, prop and projector; the picture is slightly turned and narrower at one end, as in measured ones.
inline TableSetUp some_set_up(std::mt19937_64& random) {
    TableSetUp set_up;
    set_up.artifacts = random() % 31;
    const glm::dvec2 half(between(random, 0.15, 0.7), between(random, 0.12, 0.5));
    const double roll = random() % 2 == 0 ? 0.0 : between(random, -0.03, 0.03);
    const double narrower = random() % 2 == 0 ? 1.0 : between(random, 0.9, 1.0);
    for (const glm::dvec2& corner :
         {glm::dvec2(-narrower, -1), glm::dvec2(narrower, -1), glm::dvec2(1, 1), glm::dvec2(-1, 1)}) {
        const glm::dvec2 at = corner * half;
        set_up.picture_m.emplace_back(at.x * std::cos(roll) - at.y * std::sin(roll),
                                      at.x * std::sin(roll) + at.y * std::cos(roll));
    }
    if (random() % 4 == 0) {
        set_up.prop = geometry::make_cube(between(random, 0.06, 0.2));
    } else {
        const double base = between(random, 0.08, 0.32);
        set_up.prop =
            geometry::make_frustum({base, base * between(random, 0.2, 1.0), between(random, 0.05, 0.25)});
    }
    set_up.lens_m = {between(random, -0.2, 0.2), between(random, -0.3, 0.3), between(random, 0.7, 2.2)};
    set_up.home_m = {between(random, -0.2, 0.2) * half.x, between(random, -0.2, 0.2) * half.y};
    if (random() % 2 == 0) {
        set_up.captions_m = {{0.30, between(random, 0.03, 0.08)}, {0.16, between(random, 0.06, 0.14)}};
    }
    return set_up;
}

} // namespace frustumscreen::exhibit
