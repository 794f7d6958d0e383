// Widths and volumes against closed forms, and against widths along many directions.
#include "app/solid/solid.h"
#include "tests/solid/bodies.h"

#include <gtest/gtest.h>

namespace frustumscreen::solid {
namespace {

Solid solid_of(const Body& body) {
    const Result<PropFile> file = read(body);
    EXPECT_TRUE(file.has_value()) << (file ? "" : file.error().message);
    return file.value_or(PropFile{}).solid;
}

/// The least width along `count` directions that are spread evenly over the half sphere.
double min_of_many(const std::vector<glm::dvec3>& vertices, int count) {
    const double golden = std::numbers::pi * (3.0 - std::sqrt(5.0));
    double best = 1e300;
    for (int k = 0; k < count; ++k) {
        const double z = (k + 0.5) / count;
        const double r = std::sqrt(1.0 - z * z);
        const glm::dvec3 along(r * std::cos(golden * k), r * std::sin(golden * k), z);
        double low = 1e300;
        double high = -1e300;
        for (const glm::dvec3& vertex : vertices) {
            low = std::min(low, glm::dot(along, vertex));
            high = std::max(high, glm::dot(along, vertex));
        }
        best = std::min(best, high - low);
    }
    return best;
}

TEST(MinWidth, MatchesClosedFormsOfRegularBodies) {
    EXPECT_NEAR(min_width(solid_of(cube(120))).width_m, 0.12, 1e-15);
    EXPECT_NEAR(min_width(solid_of(box(glm::dvec3(0), glm::dvec3(50, 80, 90)))).width_m, 0.05, 1e-15);
    // A regular tetrahedron of edge e: e / sqrt(2), between two opposite edges, not e * sqrt(2/3), from a face.
    Body tetrahedron;
    tetrahedron.vertices = {{0, 0, 0}, {100, 100, 0}, {100, 0, 100}, {0, 100, 100}};
    tetrahedron.faces = {{0, 1, 2}, {0, 3, 1}, {0, 2, 3}, {1, 3, 2}};
    EXPECT_NEAR(min_width(solid_of(tetrahedron)).width_m, 0.1, 1e-15);
    // A regular octahedron of edge e: e * sqrt(2/3), between two faces.
    Body octahedron;
    octahedron.vertices = {{50, 0, 0}, {0, 50, 0}, {-50, 0, 0}, {0, -50, 0}, {0, 0, 50}, {0, 0, -50}};
    for (std::size_t k = 0; k < 4; ++k) {
        octahedron.faces.push_back({k, (k + 1) % 4, 4});
        octahedron.faces.push_back({(k + 1) % 4, k, 5});
    }
    EXPECT_NEAR(min_width(solid_of(octahedron)).width_m, 0.05 * std::sqrt(2.0) * std::sqrt(2.0 / 3.0), 1e-15);
    // A prism on a regular triangle of height h: h.
    EXPECT_NEAR(min_width(solid_of(prism(3, 80, 500))).width_m, 0.12, 1e-15);
    // On a regular pentagon of radius r: from a side to the opposite corner, r (1 + cos 36).
    EXPECT_NEAR(min_width(solid_of(prism(5, 80, 500))).width_m,
                0.08 * (1.0 + std::cos(std::numbers::pi / 5.0)), 1e-15);
}

TEST(MinWidth, MatchesTheMinimumOverManyDirections) {
    std::mt19937 random(4);
    constexpr int directions = 20000;
    // Each direction lies within 2 / sqrt(N) of one of N even ones; a width changes by the diameter times that.
    const double nearness = 2.0 / std::sqrt(directions);
    int between_edges = 0;
    for (int trial = 0; trial < 40; ++trial) {
        const Body body = some_body(random, 4 + static_cast<std::size_t>(trial) % 13, 60.0);
        const Solid solid = solid_of(body);
        const SolidWidth width = min_width(solid);
        const double many = min_of_many(body.vertices, directions);
        double diameter = 0.0;
        for (const glm::dvec3& a : body.vertices) {
            for (const glm::dvec3& b : body.vertices) {
                diameter = std::max(diameter, glm::distance(a, b));
            }
        }
        EXPECT_LE(width.width_m * 1e3, many + 1e-9);
        EXPECT_GE(width.width_m * 1e3, many - nearness * diameter);
        between_edges += std::none_of(solid.faces.begin(), solid.faces.end(), [&](const SolidFace& face) {
            return std::abs(glm::dot(face.plane.normal, width.normal)) > 1.0 - 1e-12;
        });
    }
    EXPECT_GT(between_edges, 3) << "some are narrowest between two edges";
}

TEST(Solid, MovingKeepsVolumeWidthAndAreas) {
    std::mt19937 random(5);
    const Solid solid = solid_of(some_body(random, 11, 60.0));
    const geometry::RigidTransform to_from{glm::angleAxis(1.1, glm::normalize(glm::dvec3(1, -2, 0.5))),
                                           {0.3, -0.2, 0.7}};
    const Solid there = moved(solid, to_from);
    EXPECT_NEAR(volume_of(there), volume_of(solid), 1e-15);
    EXPECT_NEAR(min_width(there).width_m, min_width(solid).width_m, 1e-15);
    for (std::size_t k = 0; k < solid.faces.size(); ++k) {
        EXPECT_NEAR(area_of(there.faces[k]), area_of(solid.faces[k]), 1e-15);
        for (const glm::dvec3& corner : there.faces[k].corners) {
            EXPECT_NEAR(there.faces[k].plane.distance(corner), 0.0, 1e-9);
            EXPECT_EQ(std::count(there.corners.begin(), there.corners.end(), corner), 1);
        }
    }
}

TEST(Solid, CheckStandReportsOffsetsFromTheTable) {
    EXPECT_TRUE(check_stand(solid_of(cube(120))).has_value());
    const auto fault = [](const glm::dvec3& by) {
        const Result<void> stands = check_stand(moved(solid_of(cube(120)), {{1, 0, 0, 0}, by}));
        return stands ? std::string()
                      : fmt::format("{}: {}", stands.error().id.view(), stands.error().message);
    };
    EXPECT_EQ(fault({0, 0, 0.0001}), "");
    EXPECT_TRUE(fault({0, 0, 0.03}).starts_with("prop_file.stand: its lowest corner lies 30.0 mm above"))
        << fault({0, 0, 0.03});
    EXPECT_NE(fault({0, 0, -0.06}).find("60.0 mm below z = 0"), std::string::npos) << fault({0, 0, -0.06});
    EXPECT_EQ(fault({0.059, 0, 0}), "");
    EXPECT_NE(fault({0.061, 0, 0}).find("prop_file.axis"), std::string::npos);
    EXPECT_NE(fault({0.2, -0.1, 0}).find("(200, -100, 60) mm"), std::string::npos) << fault({0.2, -0.1, 0});
}

TEST(Solid, NarrownessReportsWidthsBelowTheEyeDistance) {
    EXPECT_EQ(narrowness(solid_of(cube(63.0))), std::nullopt);
    const std::optional<std::string> said = narrowness(solid_of(cube(62.9)));
    ASSERT_TRUE(said);
    EXPECT_NE(said->find("62.9 mm"), std::string::npos) << *said;
    EXPECT_EQ(narrowness(solid_of(cube(62.9)), 0.06), std::nullopt);
}

} // namespace
} // namespace frustumscreen::solid
