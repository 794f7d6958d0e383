#include "app/geometry/planar_hull.h"

#include <algorithm>
#include <cstddef>

namespace frustumscreen::geometry {

namespace {

double cross(const glm::dvec2& a, const glm::dvec2& b) {
    return a.x * b.y - a.y * b.x;
}

} // namespace

std::span<const glm::dvec2> planar_hull(std::span<glm::dvec2> points, std::span<glm::dvec2> chain) {
    if (points.empty()) {
        return {};
    }
    std::sort(points.begin(), points.end(),
              [](const glm::dvec2& a, const glm::dvec2& b) { return a.x != b.x ? a.x < b.x : a.y < b.y; });
    std::size_t count = 0;
    const auto add = [&](const glm::dvec2& point, std::size_t first) {
        while (count >= first + 2 &&
               cross(chain[count - 1] - chain[count - 2], point - chain[count - 1]) <= 0.0) {
            --count;
        }
        chain[count++] = point;
    };
    for (const glm::dvec2& point : points) {
        add(point, 0);
    }
    const std::size_t turn = count - 1;
    for (std::size_t k = points.size() - 1; k-- > 0;) {
        add(points[k], turn);
    }
    return chain.first(count - 1);
}

} // namespace frustumscreen::geometry
