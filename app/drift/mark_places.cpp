#include "app/drift/mark_places.h"

#include <array>
#include <cmath>

namespace frustumscreen {

namespace {

constexpr double rim_m = 0.012; // of the table that stays free: a mark is 16 mm wide

/// Shares of the picture. Neighbours in time are far apart, so that nobody sees a light that wanders.
constexpr std::array<glm::dvec2, 10> shares{{{0.04, 0.06},
                                             {0.96, 0.94},
                                             {0.96, 0.06},
                                             {0.04, 0.94},
                                             {0.35, 0.06},
                                             {0.65, 0.94},
                                             {0.65, 0.06},
                                             {0.35, 0.94},
                                             {0.04, 0.5},
                                             {0.96, 0.5}}};

} // namespace

std::vector<glm::dvec2> mark_places(const Settings& settings) {
    const Pinhole& pinhole = settings.projector.pinhole;
    const RigidTransform& pose = settings.projector.table_from_projector;
    std::vector<glm::dvec2> places;
    for (const glm::dvec2& share : shares) {
        const glm::dvec3 ray = pose.direction(pinhole.ray(share * glm::dvec2(pinhole.width, pinhole.height)));
        if (ray.z >= 0.0) {
            continue;
        }
        const glm::dvec2 place(pose.translation - ray * (pose.translation.z / ray.z));
        if (std::abs(place.x) <= 0.5 * settings.table.width_m - rim_m &&
            std::abs(place.y) <= 0.5 * settings.table.depth_m - rim_m) {
            places.push_back(place);
        }
    }
    return places;
}

} // namespace frustumscreen
