#include "app/geometry/planar_hull.h"
#include "tests/geometry/random_geometry.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

namespace frustumscreen::geometry {
namespace {

std::vector<glm::dvec2> planar_hull_of(std::vector<glm::dvec2> points) {
    std::vector<glm::dvec2> chain(points.size() + 1);
    const std::span<const glm::dvec2> hull = planar_hull(points, chain);
    return {hull.begin(), hull.end()};
}

/// Above 0 if c is to the left of the line from a to b. Exact for small whole numbers.
double side(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/// The edges a -> b of the hull by their definition: no point is to the right, and none lies farther along the line.
std::size_t edges_by_definition(const std::vector<glm::dvec2>& points) {
    std::size_t edges = 0;
    for (const glm::dvec2& a : points) {
        for (const glm::dvec2& b : points) {
            const auto is_within = [&](const glm::dvec2& c) {
                const bool on_line = side(a, b, c) == 0.0;
                return side(a, b, c) > 0.0 || (on_line && glm::dot(c - a, c - b) <= 0.0);
            };
            edges += a != b && std::all_of(points.begin(), points.end(), is_within) ? 1 : 0;
        }
    }
    return edges;
}

TEST(PlanarHull, MatchesTheDefinitionForPointsOnAGrid) {
    Random random(49);
    for (int trial = 0; trial < 300; ++trial) {
        std::vector<glm::dvec2> points;
        for (int k = 0; k < 3 + trial % 20; ++k) {
            points.push_back(glm::round(glm::dvec2(random.between(-4, 4), random.between(-4, 4))));
        }
        std::sort(points.begin(), points.end(), [](const glm::dvec2& a, const glm::dvec2& b) {
            return a.x != b.x ? a.x < b.x : a.y < b.y;
        });
        points.erase(std::unique(points.begin(), points.end()), points.end());
        std::vector<glm::dvec2> twice(points);
        twice.insert(twice.end(), points.begin(), points.end());
        const std::vector<glm::dvec2> hull = planar_hull_of(twice);
        EXPECT_EQ(hull.size(), edges_by_definition(points)) << "trial " << trial;
        for (std::size_t k = 0; hull.size() > 2 && k < hull.size(); ++k) {
            EXPECT_GT(side(hull[k], hull[(k + 1) % hull.size()], hull[(k + 2) % hull.size()]), 0.0)
                << "trial " << trial;
        }
    }
}

TEST(PlanarHull, NoPointAndOnePointGiveAnEmptyHull) {
    EXPECT_TRUE(planar_hull_of({}).empty());
    EXPECT_TRUE(planar_hull_of({{3.0, 4.0}}).empty());
    EXPECT_EQ(planar_hull_of({{3.0, 4.0}, {1.0, 1.0}}).size(), 2U);
}

} // namespace
} // namespace frustumscreen::geometry
