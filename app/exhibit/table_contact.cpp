#include "app/exhibit/table_contact.h"

#include <algorithm>
#include <limits>

namespace frustumscreen::exhibit {

namespace {

/// The outward normal of the edge that begins at corner `k`.
glm::dvec2 normal_of(std::span<const glm::dvec2> polygon, std::size_t k) {
    const glm::dvec2 edge = polygon[(k + 1) % polygon.size()] - polygon[k];
    return glm::normalize(glm::dvec2(edge.y, -edge.x));
}

double farthest(std::span<const glm::dvec2> polygon, const glm::dvec2& along) {
    double most = -std::numeric_limits<double>::infinity();
    for (const glm::dvec2& corner : polygon) {
        most = std::max(most, glm::dot(corner, along));
    }
    return most;
}

} // namespace

std::optional<glm::dvec2> slide_clear(std::span<const glm::dvec2> thing, std::span<const glm::dvec2> other,
                                      double gap_m) {
    double least = std::numeric_limits<double>::infinity();
    glm::dvec2 way(0.0);
    const auto consider = [&](const glm::dvec2& away) { // from `other`
        const double by = farthest(other, away) + gap_m + farthest(thing, -away);
        if (by < least) {
            least = by;
            way = by * away;
        }
    };
    for (std::size_t k = 0; k < other.size(); ++k) {
        consider(normal_of(other, k));
    }
    for (std::size_t k = 0; k < thing.size(); ++k) {
        consider(-normal_of(thing, k));
    }
    return least > 0.0 && least < std::numeric_limits<double>::infinity() ? std::optional(way) : std::nullopt;
}

bool lies_in(const glm::dvec2& point, std::span<const glm::dvec2> polygon, double border_m) {
    for (std::size_t k = 0; k < polygon.size(); ++k) {
        if (glm::dot(point - polygon[k], normal_of(polygon, k)) > -border_m) {
            return false;
        }
    }
    return polygon.size() >= 3;
}

} // namespace frustumscreen::exhibit
