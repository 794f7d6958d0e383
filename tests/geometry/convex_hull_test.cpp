#include "app/geometry/convex_hull.h"
#include "tests/geometry/random_geometry.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace frustumscreen::geometry {
namespace {

double reach(const std::vector<glm::dvec3>& points, const glm::dvec3& along) {
    double most = -1e300;
    for (const glm::dvec3& point : points) {
        most = std::max(most, glm::dot(point, along));
    }
    return most;
}

glm::dvec3 direction(Random& random) {
    return random.direction();
}

/// By how much the corners reach farther than the points, along many directions: at least, at most.
std::pair<double, double> farther_by(const std::vector<glm::dvec3>& points,
                                     const std::vector<glm::dvec3>& corners, Random& random) {
    std::pair<double, double> range{1e300, -1e300};
    for (int k = 0; k < 2000; ++k) {
        const glm::dvec3 along = direction(random);
        const double by = reach(corners, along) - reach(points, along);
        range = {std::min(range.first, by), std::max(range.second, by)};
    }
    return range;
}

TEST(ConvexHull, FewCornersAreExact) {
    Random random(7);
    std::vector<glm::dvec3> points;
    for (unsigned k = 0; k < 8; ++k) {
        points.emplace_back((k & 1U) != 0 ? 0.5 : -0.5, (k & 2U) != 0 ? 0.3 : -0.3,
                            (k & 4U) != 0 ? 1.0 : 0.0);
    }
    for (int k = 0; k < 500; ++k) { // inside, on faces, on edges
        const glm::dvec3 inside(random.between(-0.5, 0.5), random.between(-0.3, 0.3),
                                random.between(0.0, 1.0));
        points.push_back(inside);
        points.emplace_back(0.5, inside.y, inside.z);
        points.emplace_back(0.5, 0.3, inside.z);
    }
    const std::vector<glm::dvec3> corners = enclosing_corners(points, 64);
    EXPECT_EQ(corners.size(), 8U);
    const auto [least, most] = farther_by(points, corners, random);
    EXPECT_GE(least, -1e-12);
    EXPECT_LE(most, 1e-12);
}

TEST(ConvexHull, ManyPointsAreEnclosedByFewerCorners) {
    Random random(8);
    for (const double thickness : {1.0, 0.3, 0.02}) {
        std::vector<glm::dvec3> points;
        for (int k = 0; k < 4000; ++k) {
            points.push_back(direction(random) * glm::dvec3(1.0, 0.8, thickness));
        }
        for (const std::size_t max_corners : {std::size_t{40}, std::size_t{192}}) {
            const std::vector<glm::dvec3> corners = enclosing_corners(points, max_corners);
            EXPECT_LE(corners.size(), max_corners);
            const auto [least, most] = farther_by(points, corners, random);
            EXPECT_GE(least, -1e-9) << thickness; // it holds them all
            // N corners on a ball lie 3.8 / sqrt(N) apart: its caps are higher than their triangles by 2.4 / N.
            EXPECT_LE(most, 3.0 * 2.4 / static_cast<double>(max_corners)) << thickness;
        }
    }
}

TEST(ConvexHull, EnclosesSheetsLinesAndPoints) {
    Random random(9);
    const glm::dvec3 normal = direction(random);
    const glm::dvec3 across = glm::normalize(glm::cross(normal, glm::dvec3(0.3, 0.2, 0.9)));
    const glm::dvec3 along = glm::cross(normal, across);
    std::vector<glm::dvec3> sheet;
    std::vector<glm::dvec3> line;
    for (int k = 0; k < 300; ++k) {
        sheet.push_back(random.between(-1, 1) * across + random.between(-1, 1) * along);
        line.push_back(random.between(-1, 1) * across);
    }
    const auto [least, most] = farther_by(sheet, enclosing_corners(sheet, 64), random);
    EXPECT_GE(least, -1e-9);
    EXPECT_LE(most, 1e-4);
    EXPECT_GE(farther_by(line, enclosing_corners(line, 64), random).first, -1e-9); // their box
    EXPECT_EQ(enclosing_corners(std::vector{normal, normal}, 64), std::vector{normal});
}

} // namespace
} // namespace frustumscreen::geometry
