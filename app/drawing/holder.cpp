#include "app/drawing/holder.h"

#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace frustumscreen::drawing {

namespace {

constexpr double plate_m = 0.004;
/// The rim hides the sides' lowest part from visitors, so it is no higher than necessary.
constexpr double max_rim_m = 0.006;
constexpr double max_rim_share = 0.1; ///< of the prop's height

/// The area that the prop covers from its foot up to a height, from above. The prop is convex: a line between any two of its
/// corners lies in it, and those between neighbours bound it.
settings::Polygon covered_up_to(const geometry::PropShape& prop, double height_m) {
    std::vector<glm::dvec2> places;
    for (const glm::dvec3& low : prop.corners) {
        if (low.z > height_m) {
            continue;
        }
        places.emplace_back(low);
        for (const glm::dvec3& high : prop.corners) {
            if (high.z > height_m) {
                places.emplace_back(glm::mix(low, high, (height_m - low.z) / (high.z - low.z)));
            }
        }
    }
    return settings::convex_polygon(std::move(places));
}

/// Each edge moved outward, the corners where they meet.
settings::Polygon widened(const settings::Polygon& polygon, double by_m) {
    settings::Polygon wide;
    for (std::size_t k = 0; k < polygon.size(); ++k) {
        const glm::dvec2& here = polygon[k];
        const glm::dvec2 in = glm::normalize(here - polygon[(k + polygon.size() - 1) % polygon.size()]);
        const glm::dvec2 out = glm::normalize(polygon[(k + 1) % polygon.size()] - here);
        const glm::dvec2 outward(in.y + out.y, -in.x - out.x);
        wide.push_back(here + 2.0 * by_m / glm::dot(outward, outward) * outward);
    }
    return wide;
}

} // namespace

Holder holder_for(const geometry::PropShape& prop) {
    double high_m = 0.0;
    for (const glm::dvec3& corner : prop.corners) {
        high_m = std::fmax(high_m, corner.z);
    }
    const double rim_m = std::fmin(max_rim_m, max_rim_share * high_m);
    Holder holder{.pocket = widened(covered_up_to(prop, rim_m), holder_play_m),
                  .plate = {},
                  .plate_m = plate_m,
                  .rim_m = rim_m};
    holder.plate = widened(holder.pocket, holder_rim_width_m);
    return holder;
}

} // namespace frustumscreen::drawing
