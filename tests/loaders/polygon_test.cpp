#include "assets_baked/bake/loaders/polygon.h"

#include <gtest/gtest.h>

#include <cmath>

namespace frustumscreen::testing {
namespace {

using Triangles = std::vector<std::array<std::uint32_t, 3>>;

/// Signed area of each triangle, seen against +Z.
std::vector<double> signed_areas(const std::vector<glm::dvec3>& corners, const Triangles& triangles) {
    std::vector<double> areas;
    for (const auto& [a, b, c] : triangles) {
        areas.push_back(0.5 * glm::cross(corners[b] - corners[a], corners[c] - corners[a]).z);
    }
    return areas;
}

void expect_covered(const std::vector<glm::dvec3>& corners, double area) {
    Triangles triangles;
    bake::triangulate_polygon(corners, triangles);
    ASSERT_EQ(triangles.size(), corners.size() - 2);
    double sum = 0.0;
    for (const double part : signed_areas(corners, triangles)) {
        EXPECT_GE(part, 0.0) << "no triangle lies outside the polygon";
        sum += part;
    }
    EXPECT_NEAR(sum, area, 1e-12);
}

TEST(Polygon, AConvexPolygonIsCovered) {
    expect_covered({{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {0, 1, 0}}, 2.0);
}

TEST(Polygon, ConcaveQuadIsCoveredWithoutOverlap) {
    // An arrowhead, with its notch at each corner in turn.
    const std::vector<glm::dvec3> arrow = {{0, 0, 0}, {2, 1, 0}, {0, 2, 0}, {1, 1, 0}};
    for (std::size_t turn = 0; turn < 4; ++turn) {
        std::vector<glm::dvec3> corners;
        for (std::size_t i = 0; i < 4; ++i) {
            corners.push_back(arrow[(i + turn) % 4]);
        }
        expect_covered(corners, 1.0);
    }
}

TEST(Polygon, AStarOfTwentyCornersIsCovered) {
    std::vector<glm::dvec3> corners;
    for (int i = 0; i < 20; ++i) {
        const double angle = i * std::acos(-1.0) / 10.0;
        const double radius = i % 2 == 0 ? 2.0 : 1.0;
        corners.emplace_back(radius * std::cos(angle), radius * std::sin(angle), 0.0);
    }
    expect_covered(corners, 20.0 * 0.5 * 2.0 * 1.0 * std::sin(std::acos(-1.0) / 10.0));
}

/// A plus sign with `steps` corners along each of its twelve edges, 5 square units.
std::vector<glm::dvec3> cross_of(int steps) {
    const std::vector<glm::dvec3> outline = {{1, 0, 0}, {2, 0, 0}, {2, 1, 0}, {3, 1, 0},
                                             {3, 2, 0}, {2, 2, 0}, {2, 3, 0}, {1, 3, 0},
                                             {1, 2, 0}, {0, 2, 0}, {0, 1, 0}, {1, 1, 0}};
    std::vector<glm::dvec3> corners;
    for (std::size_t k = 0; k < outline.size(); ++k) {
        for (int i = 0; i < steps; ++i) {
            corners.push_back(glm::mix(outline[k], outline[(k + 1) % outline.size()], double(i) / steps));
        }
    }
    return corners;
}

TEST(Polygon, AConcavePolygonMayHaveAnyNumberOfCorners) {
    for (const int steps : {1, 4, 6, 32, 250}) {
        expect_covered(cross_of(steps), 5.0);
    }
}

TEST(Polygon, ACombOfAThousandTeethIsCovered) {
    std::vector<glm::dvec3> corners = {{0, 0, 0}, {2000, 0, 0}};
    for (int tooth = 999; tooth >= 0; --tooth) {
        corners.emplace_back(2 * tooth + 2, 1, 0);
        corners.emplace_back(2 * tooth + 1, 3, 0);
    }
    corners.emplace_back(0, 1, 0);
    Triangles triangles;
    bake::triangulate_polygon(corners, triangles);
    double sum = 0.0;
    for (const double part : signed_areas(corners, triangles)) {
        EXPECT_GE(part, 0.0);
        sum += part;
    }
    EXPECT_NEAR(sum, 2000.0 + 1000.0 * 2.0, 1e-9);
}

TEST(Polygon, OutlineWithABridgedHoleIsCovered) {
    // A square of 4 by 4 with a hole of 2 by 2, cut open along one line.
    expect_covered({{0, 0, 0},
                    {4, 0, 0},
                    {4, 4, 0},
                    {0, 4, 0},
                    {0, 0, 0},
                    {1, 1, 0},
                    {1, 3, 0},
                    {3, 3, 0},
                    {3, 1, 0},
                    {1, 1, 0}},
                   12.0);
}

TEST(Polygon, CrossingOrDegeneratePolygonStillGivesItsTriangles) {
    for (const std::vector<glm::dvec3>& corners :
         {std::vector<glm::dvec3>{{0, 0, 0}, {1, 1, 0}, {1, 0, 0}, {0, 1, 0}}, std::vector<glm::dvec3>(6)}) {
        Triangles triangles;
        bake::triangulate_polygon(corners, triangles);
        EXPECT_EQ(triangles.size(), corners.size() - 2);
    }
}

TEST(Polygon, FewerThanThreeCornersGiveNothing) {
    Triangles triangles;
    bake::triangulate_polygon(std::vector<glm::dvec3>(2), triangles);
    EXPECT_TRUE(triangles.empty());
}

} // namespace
} // namespace frustumscreen::testing
