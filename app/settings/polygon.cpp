#include "app/settings/polygon.h"

#include "app/geometry/planar_hull.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace frustumscreen::settings {

namespace {

glm::dvec2 centroid(const Polygon& polygon) {
    glm::dvec2 sum(0.0);
    double area = 0.0;
    for (std::size_t k = 1; k + 1 < polygon.size(); ++k) {
        const glm::dvec2 a = polygon[k] - polygon[0];
        const glm::dvec2 b = polygon[k + 1] - polygon[0];
        const double twice = a.x * b.y - a.y * b.x;
        area += twice;
        sum += twice * (polygon[0] + (a + b) / 3.0);
    }
    return sum / area;
}

} // namespace

Polygon clipped(const Polygon& polygon, const HalfPlane& keep) {
    Polygon result;
    for (std::size_t k = 0; k < polygon.size(); ++k) {
        const glm::dvec2& a = polygon[k];
        const glm::dvec2& b = polygon[(k + 1) % polygon.size()];
        const double a_inside = glm::dot(keep.inward, a) - keep.offset;
        const double b_inside = glm::dot(keep.inward, b) - keep.offset;
        if (a_inside >= 0.0) {
            result.push_back(a);
        }
        if ((a_inside > 0.0 && b_inside < 0.0) || (a_inside < 0.0 && b_inside > 0.0)) {
            result.push_back(a + (b - a) * (a_inside / (a_inside - b_inside)));
        }
    }
    return result;
}

Rectangle rectangle_inside(const Polygon& polygon) {
    if (polygon.empty()) {
        return {};
    }
    Rectangle best{centroid(polygon), glm::dvec2(0.0)};
    constexpr int shapes = 360;
    for (int shape = 1; shape < shapes; ++shape) {
        const double angle = 0.5 * std::numbers::pi * shape / shapes;
        const glm::dvec2 half(std::cos(angle), std::sin(angle));
        double scale = std::numeric_limits<double>::infinity();
        for (std::size_t k = 0; k < polygon.size(); ++k) {
            const glm::dvec2 along = polygon[(k + 1) % polygon.size()] - polygon[k];
            const glm::dvec2 outward(along.y, -along.x);
            const double distance = glm::dot(outward, polygon[k] - best.centre_m);
            const double reach = glm::dot(glm::abs(outward), half);
            scale = reach > 0.0 ? std::fmin(scale, distance / reach) : scale;
        }
        const glm::dvec2 scaled = half * scale;
        best.half_m = scaled.x * scaled.y > best.half_m.x * best.half_m.y ? scaled : best.half_m;
    }
    return best;
}

Polygon convex_polygon(std::vector<glm::dvec2> points) {
    Polygon chain(points.size() + 1);
    chain.resize(geometry::planar_hull(points, chain).size());
    return chain;
}

double area_of(const Polygon& polygon) {
    double twice = 0.0;
    for (std::size_t k = 0; k < polygon.size(); ++k) {
        const glm::dvec2& a = polygon[k];
        const glm::dvec2& b = polygon[(k + 1) % polygon.size()];
        twice += a.x * b.y - a.y * b.x;
    }
    return 0.5 * twice;
}

} // namespace frustumscreen::settings
