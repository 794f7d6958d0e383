#include "app/drift/mark_places.h"

#include "app/geometry/table_plane.h"

#include <array>
#include <cmath>

namespace frustumscreen::drift {

namespace {

constexpr double rim_m = 0.012; // free edge of the table; a mark is 16 mm wide

/// Shares of the picture. Successive marks are far apart, so they do not look like a moving light.
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

std::vector<glm::dvec2> mark_places(const settings::Settings& settings) {
    const geometry::Pinhole& pinhole = settings.projector.pinhole;
    std::vector<glm::dvec2> places;
    for (const glm::dvec2& share : shares) {
        const std::optional<glm::dvec2> place =
            geometry::lights_table(pinhole, settings.projector.table_from_projector,
                                   share * glm::dvec2(pinhole.width, pinhole.height));
        if (place && std::abs(place->x) <= 0.5 * settings.table.width_m - rim_m &&
            std::abs(place->y) <= 0.5 * settings.table.depth_m - rim_m) {
            places.push_back(*place);
        }
    }
    return places;
}

} // namespace frustumscreen::drift
