#include "app/world/site_view.h"

#include <cmath>
#include <limits>
#include <utility>

namespace frustumscreen::world {

glm::dmat4 SiteView::matrix() const {
    glm::dmat4 matrix(1.0);
    for (int axis = 0; axis < 3; ++axis) {
        matrix[axis] *= zoom;
    }
    matrix[3] = glm::dvec4(offset, 1.0);
    return matrix;
}

SiteView view_of(const glm::dvec3& place, double zoom) {
    return {zoom, -zoom * place};
}

/// Size and offset are linear in the same weight, so places go along straight lines. With L the logarithm of the sizes' ratio the
/// weight is (exp(L share) - 1) / (exp(L) - 1); the sizes are then exponential in `share`.
SiteView between(const SiteView& from, const SiteView& to, double share) {
    if (share <= 0.0) {
        return from;
    }
    if (share >= 1.0) {
        return to;
    }
    const double ratio = std::log(to.zoom / from.zoom);
    constexpr double equal = 1e-9;
    const double weight = std::abs(ratio) < equal ? share : std::expm1(ratio * share) / std::expm1(ratio);
    return {from.zoom + weight * (to.zoom - from.zoom), glm::mix(from.offset, to.offset, weight)};
}

glm::dvec3 ground_of(const RegionBox& region) {
    const glm::dvec3 middle = glm::mix(region.low, region.high, 0.5);
    return {middle.x, middle.y, region.low.z};
}

std::optional<std::size_t> region_at(std::span<const RegionBox> regions, const glm::dvec2& place) {
    std::optional<std::size_t> found;
    double nearest = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < regions.size(); ++k) {
        const glm::dvec2 low(regions[k].low);
        const glm::dvec2 high(regions[k].high);
        const double away = glm::distance(place, glm::mix(low, high, 0.5));
        if (glm::all(glm::lessThanEqual(low, place)) && glm::all(glm::lessThanEqual(place, high)) &&
            away < nearest) {
            found = k;
            nearest = away;
        }
    }
    return found;
}

std::optional<std::size_t> region_on_ray(std::span<const RegionBox> regions, const glm::dvec3& from,
                                         const glm::dvec3& along) {
    std::optional<std::size_t> found;
    double longest = -1.0; // a flat region's is 0
    for (std::size_t k = 0; k < regions.size(); ++k) {
        double enters = 0.0;
        double leaves = std::numeric_limits<double>::infinity();
        for (int axis = 0; axis < 3; ++axis) {
            if (along[axis] == 0.0) {
                const bool within = regions[k].low[axis] <= from[axis] && from[axis] <= regions[k].high[axis];
                leaves = within ? leaves : -1.0;
                continue;
            }
            double near = (regions[k].low[axis] - from[axis]) / along[axis];
            double far = (regions[k].high[axis] - from[axis]) / along[axis];
            if (near > far) {
                std::swap(near, far);
            }
            enters = std::fmax(enters, near);
            leaves = std::fmin(leaves, far);
        }
        if (leaves >= enters && leaves - enters > longest) {
            found = k;
            longest = leaves - enters;
        }
    }
    return found;
}

} // namespace frustumscreen::world
