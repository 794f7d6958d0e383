#include "app/geometry/corner_fan.h"
#include "app/geometry/inner_point.h"
#include "app/geometry/prop_shape.h"
#include "app/geometry/union_find.h"
#include "tests/geometry/random_geometry.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <random>
#include <set>
#include <vector>

namespace frustumscreen::geometry {
namespace {

/// Half the side of the prop's square section at height z.
double half_at(const FrustumSize& size, double z) {
    return (size.base_m + (size.top_m - size.base_m) * z / size.height_m) / 2.0;
}

bool inside(const FrustumSize& size, const glm::dvec3& p, double margin = 0.0) {
    const double half = half_at(size, p.z) + margin;
    return p.z >= -margin && p.z <= size.height_m + margin && std::abs(p.x) <= half && std::abs(p.y) <= half;
}

TEST(PropShape, FacesLookOutwardsInTheOrderOfTheHeader) {
    Random random(21);
    for (int k = 0; k < 200; ++k) {
        const FrustumSize size = random.prop();
        const PropShape prop = make_frustum(size);
        ASSERT_EQ(prop.faces.size(), 5U);
        const std::array<glm::dvec3, 5> expected{
            glm::dvec3(1, 0, 0), {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}};
        const std::array<std::string_view, 5> names{"+X", "-X", "+Y", "-Y", "+Z"};
        const double rise = (size.base_m - size.top_m) / 2.0 / size.height_m;
        for (std::size_t f = 0; f < 5; ++f) {
            const Plane& plane = prop.faces[f].plane;
            const glm::dvec3 normal =
                f < 4 ? glm::normalize(expected[f] + glm::dvec3(0, 0, rise)) : expected[f];
            EXPECT_LT(glm::distance(plane.normal, normal), 1e-12);
            EXPECT_LT(plane.distance({0, 0, size.height_m / 2}), 0.0);
            EXPECT_EQ(prop.bounds[f].normal, plane.normal);
            EXPECT_EQ(prop.faces[f].name, names[f]);
        }
        EXPECT_EQ(prop.bounds.back().normal, glm::dvec3(0, 0, -1));
    }
}

TEST(PropShape, CornersLieOnThePlaneAndOnTheSolidCounterClockwise) {
    Random random(22);
    for (int k = 0; k < 200; ++k) {
        const FrustumSize size = random.prop();
        for (const PropFace& face : make_frustum(size).faces) {
            glm::dvec3 area(0.0);
            for (std::size_t c = 0; c < 4; ++c) {
                const glm::dvec3& corner = face.corners[c];
                EXPECT_NEAR(face.plane.distance(corner), 0.0, 1e-14);
                EXPECT_NEAR(std::abs(corner.x), half_at(size, corner.z), 1e-14);
                EXPECT_NEAR(std::abs(corner.y), half_at(size, corner.z), 1e-14);
                area += glm::cross(corner, face.corners[(c + 1) % 4]);
            }
            EXPECT_NEAR(glm::dot(glm::normalize(area), face.plane.normal), 1.0, 1e-12);
        }
    }
}

TEST(PropShape, ACubeIsAsWideAtTheTopAsAtTheBottom) {
    const PropShape cube = make_cube(0.1);
    EXPECT_EQ(cube.faces[0].plane.normal, glm::dvec3(1, 0, 0));
    EXPECT_EQ(cube.faces[4].corners[2], glm::dvec3(0.05, 0.05, 0.1));
}

TEST(PropShape, ACubesSixFacesBoundIt) {
    const PropShape cube = make_cube(0.1);
    ASSERT_EQ(cube.faces.size(), 6U);
    ASSERT_EQ(cube.bounds.size(), 6U);
    glm::dvec3 sum(0.0);
    for (const PropFace& face : cube.faces) {
        const auto axis = static_cast<std::size_t>(face.name[1] - 'X');
        const double sign = face.name[0] == '+' ? 1.0 : -1.0;
        glm::dvec3 normal(0.0);
        normal[static_cast<glm::length_t>(axis)] = sign;
        EXPECT_EQ(face.plane.normal, normal) << face.name;
        EXPECT_NEAR(face.plane.distance(cube.middle), -0.05, 1e-15) << face.name;
        for (const glm::dvec3& corner : face.corners) {
            EXPECT_NEAR(face.plane.distance(corner), 0.0, 1e-15) << face.name;
            sum += corner - cube.middle;
        }
    }
    EXPECT_LT(glm::length(sum), 1e-15);
    PropHit hit;
    ASSERT_TRUE(intersect(cube, {0.01, 0.02, -1.0}, {0.0, 0.0, 1.0}, hit));
    EXPECT_EQ(cube.faces[static_cast<std::size_t>(hit.face)].name, "-Z");
    EXPECT_EQ(hit.t, 1.0);
}

TEST(PropShape, AFrustumIsEnteredByItsBottomButNotLitThere) {
    const PropShape prop = make_frustum({});
    PropHit hit;
    ASSERT_TRUE(enter(prop, {0, 0, -1}, {0, 0, 1}, hit));
    EXPECT_EQ(prop.bounds[static_cast<std::size_t>(hit.face)].normal, glm::dvec3(0, 0, -1));
    EXPECT_FALSE(intersect(prop, {0, 0, -1}, {0, 0, 1}, hit));
}

/// A ray's entry point, found by walking along it: first point inside, refined by bisection.
struct Walked {
    bool enters = false;
    glm::dvec3 at{0.0};
};
Walked walk(const FrustumSize& size, const glm::dvec3& origin, const glm::dvec3& direction, double length) {
    constexpr int steps = 4000;
    for (int k = 1; k <= steps; ++k) {
        if (inside(size, origin + direction * (length * k / steps))) {
            double out = length * (k - 1) / steps;
            double in = length * k / steps;
            for (int halving = 0; halving < 60; ++halving) {
                const double middle = (out + in) / 2;
                (inside(size, origin + direction * middle) ? in : out) = middle;
            }
            return {true, origin + direction * in};
        }
    }
    return {};
}

TEST(PropShape, RaysEnterAtThePointFoundByStepping) {
    Random random(23);
    int hits = 0;
    for (int k = 0; k < 3000; ++k) {
        const FrustumSize size = random.prop();
        const PropShape prop = make_frustum(size);
        const glm::dvec3 origin = random.direction() * random.between(1.0, 3.0) + glm::dvec3(0, 0, 0.2);
        const glm::dvec3 aim(random.between(-0.4, 0.4) * size.base_m, random.between(-0.4, 0.4) * size.base_m,
                             random.between(0.0, 1.0) * size.height_m);
        const glm::dvec3 direction = glm::normalize(aim - origin) * random.scale(0.1, 10.0);
        const double length = 4.0 / glm::length(direction);
        const Walked walked = walk(size, origin, direction, length);
        PropHit hit;
        const bool found = intersect(prop, origin, direction, hit);
        const bool by_bottom = walked.enters && walked.at.z < 1e-9 && origin.z < 0.0;
        if (!walked.enters || by_bottom) {
            // The ray may graze a corner within less than a step of the walk.
            if (found) {
                const glm::dvec3 at = origin + direction * hit.t;
                EXPECT_TRUE(inside(size, at, 1e-9));
                EXPECT_FALSE(by_bottom);
            }
            continue;
        }
        ASSERT_TRUE(found);
        ++hits;
        const glm::dvec3 at = origin + direction * hit.t;
        EXPECT_LT(glm::distance(at, walked.at), 1e-9);
        EXPECT_NEAR(prop.faces[static_cast<std::size_t>(hit.face)].plane.distance(at), 0.0, 1e-9);
    }
    EXPECT_GT(hits, 1000);
}

TEST(PropShape, RaysAwayBesideFromInsideAndThroughTheBottomMiss) {
    const PropShape prop = make_frustum({});
    PropHit hit;
    EXPECT_FALSE(intersect(prop, {0, 0, 1}, {0, 0, 1}, hit));
    EXPECT_FALSE(intersect(prop, {0.2, 0, 1}, {0, 0, -1}, hit)); // parallel to a plane's normal, next to the
                                                                 // prop
    EXPECT_FALSE(intersect(prop, {0, 0, 0.05}, {1, 0, 0}, hit));
    EXPECT_FALSE(intersect(prop, {0, 0, -1}, {0, 0, 1}, hit));
    EXPECT_FALSE(intersect(prop, {0, 0, 1}, {0, 0, 0}, hit));
    EXPECT_FALSE(intersect(prop, {0, 0, 1}, {std::nan(""), 0, -1}, hit));
    ASSERT_TRUE(intersect(prop, {0, 0, 1}, {0, 0, -1}, hit));
    EXPECT_EQ(hit.face, 4);
    EXPECT_NEAR(hit.t, 0.88, 1e-12);
}

TEST(PropShape, TheLargestScaleTouchesAndFits) {
    Random random(24);
    for (int k = 0; k < 500; ++k) {
        const FrustumSize size = random.prop();
        const PropShape prop = make_frustum(size);
        const double unit = random.scale(1e-3, 1e3);
        std::vector<glm::dvec3> points{{0, 0, 0}, {0.3 * unit, 0, 0}};
        for (int p = 0; p < 50; ++p) {
            points.emplace_back(random.between(-unit, unit), random.between(-unit, unit),
                                random.between(0.0, unit));
        }
        const double scale = largest_scale_inside(prop, points);
        const auto all_inside = [&](double s) {
            return std::all_of(points.begin(), points.end(),
                               [&](const auto& p) { return inside(size, p * s); });
        };
        EXPECT_TRUE(all_inside(scale * (1 - 1e-9)));
        EXPECT_FALSE(all_inside(scale * (1 + 1e-9)));
    }
}

TEST(PropShape, TheLargestScaleOfNothingOrOfOnePointOnTheBottomIsInfinite) {
    const PropShape prop = make_frustum({});
    EXPECT_EQ(largest_scale_inside(prop, {}), std::numeric_limits<double>::infinity());
    const std::vector<glm::dvec3> origin{{0, 0, 0}};
    EXPECT_EQ(largest_scale_inside(prop, origin), std::numeric_limits<double>::infinity());
}

TEST(PropShape, AFacesMiddleIsEquidistantFromItsUpperCorners) {
    const PropShape prop = make_frustum({0.16, 0.09, 0.12});
    EXPECT_NEAR(glm::distance(prop.faces[4].middle(), glm::dvec3(0.0, 0.0, 0.12)), 0.0, 1e-15) << "the top's";
    for (const PropFace& face : prop.faces) {
        EXPECT_NEAR(face.plane.distance(face.middle()), 0.0, 1e-15) << face.name;
        EXPECT_NEAR(glm::distance(face.middle(), face.corners[2]),
                    glm::distance(face.middle(), face.corners[3]), 1e-15)
            << face.name;
    }
    EXPECT_NEAR(prop.faces[0].middle().x, 0.25 * (0.16 + 0.09), 1e-15) << "between bottom and top";
}

TEST(PropShape, InnerPointIsOnTheDiagonalOrTheMeanOfTheCorners) {
    for (const PropShape& prop : {make_frustum({0.16, 0.09, 0.12}), make_cube(0.1)}) {
        for (const PropFace& face : prop.faces) {
            EXPECT_EQ(inner_point(face), 0.5 * (face.corners[0] + face.corners[2])) << face.name;
        }
    }
    const PropFace triangle{.name = "", .plane = {}, .corners = {{0, 0, 0}, {3, 0, 0}, {0, 6, 3}}};
    EXPECT_EQ(inner_point(triangle), glm::dvec3(1, 2, 1));
}

/// A prism that stands on a polygon of `sides` corners, its first side perpendicular to +X.
PropShape prism(int sides) {
    PropShape prop;
    for (const double z : {0.1, 0.0}) {
        for (int k = 0; k < sides; ++k) {
            const double azimuth = 2.0 * std::numbers::pi * (k - 0.5) / sides;
            prop.corners.emplace_back(0.06 * std::cos(azimuth), 0.06 * std::sin(azimuth), z);
        }
    }
    return prop;
}

TEST(PropShape, FootConsistsOfTheCornersOnTheTable) {
    const PropShape frustum = make_frustum({0.16, 0.09, 0.12});
    EXPECT_EQ(foot_of(frustum), (std::vector<glm::dvec3>{
                                    {-0.08, -0.08, 0}, {0.08, -0.08, 0}, {0.08, 0.08, 0}, {-0.08, 0.08, 0}}));
    const std::vector<glm::dvec3> foot = foot_of(prism(5));
    ASSERT_EQ(foot.size(), 5U);
    for (std::size_t k = 0; k < foot.size(); ++k) {
        const glm::dvec3 edge = foot[(k + 1) % 5] - foot[k];
        EXPECT_EQ(foot[k].z, 0.0);
        EXPECT_NEAR(glm::length(edge), 0.12 * std::sin(std::numbers::pi / 5.0), 1e-15);
        EXPECT_GT(glm::cross(foot[k], edge).z, 0.0) << "counter-clockwise";
    }
    PropShape tip;
    tip.corners = {{0.0, 0.0, 0.0}, {0.1, 0.0, 0.1}, {-0.1, 0.1, 0.1}, {-0.1, -0.1, 0.1}};
    EXPECT_EQ(foot_of(tip), std::vector<glm::dvec3>{glm::dvec3(0.0)});
}

TEST(PropShape, QuarterTurnsMatchTheSymmetry) {
    EXPECT_EQ(quarters_to_same(make_frustum({})), 1);
    EXPECT_EQ(quarters_to_same(make_cube(0.1)), 1);
    EXPECT_EQ(quarters_to_same(prism(4)), 1);
    EXPECT_EQ(quarters_to_same(prism(6)), 2);
    EXPECT_EQ(quarters_to_same(prism(3)), 4);
    EXPECT_EQ(quarters_to_same(prism(8)), 1);
}

TEST(CornerFan, CoversThePolygonWithoutGapsAndOverlaps) {
    for (std::size_t corners = 3; corners <= max_face_corners; ++corners) {
        const auto at = [&](std::size_t k) {
            const double azimuth =
                2.0 * std::numbers::pi * static_cast<double>(k) / static_cast<double>(corners);
            return glm::dvec2(std::cos(azimuth), std::sin(azimuth));
        };
        const auto area = [](const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c) {
            return 0.5 * ((b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x));
        };
        double whole = 0.0;
        for (std::size_t k = 0; k < fan_quads(corners); ++k) {
            const auto [a, b, c, d] = fan_quad(corners, k);
            ASSERT_LT(std::max({a, b, c, d}), corners);
            for (const double part : {area(at(a), at(b), at(c)), area(at(a), at(c), at(d))}) {
                EXPECT_GE(part, 0.0);
                whole += part;
            }
        }
        const double angle = 2.0 * std::numbers::pi / static_cast<double>(corners);
        EXPECT_NEAR(whole, 0.5 * static_cast<double>(corners) * std::sin(angle), 1e-12) << corners;
    }
    EXPECT_EQ(fan_quads(4), 1U);
    EXPECT_EQ(fan_quad(4, 0), (std::array<std::size_t, 4>{0, 1, 2, 3}));
}

TEST(UnionFind, JoinsConnectedElements) {
    std::mt19937 random(5);
    for (int graph = 0; graph < 50; ++graph) {
        constexpr std::uint32_t count = 40;
        std::array<std::array<bool, count>, count> connected{};
        UnionFind sets(count);
        std::size_t joined = 0;
        for (std::uint32_t k = 0; k < count; ++k) {
            connected[k][k] = true;
        }
        for (int edge = 0; edge < 25; ++edge) {
            const auto a = static_cast<std::uint32_t>(random() % count);
            const auto b = static_cast<std::uint32_t>(random() % count);
            EXPECT_EQ(sets.join(a, b), !connected[a][b]);
            joined += connected[a][b] ? 0U : 1U;
            for (std::uint32_t i = 0; i < count; ++i) { // all that reach a reach what b reaches
                for (std::uint32_t j = 0; j < count; ++j) {
                    if ((connected[i][a] && connected[b][j]) || (connected[i][b] && connected[a][j])) {
                        connected[i][j] = connected[j][i] = true;
                    }
                }
            }
        }
        const std::vector<std::uint32_t> roots = sets.roots();
        for (std::uint32_t i = 0; i < count; ++i) {
            EXPECT_EQ(roots[i], sets.root(i));
            for (std::uint32_t j = 0; j < count; ++j) {
                EXPECT_EQ(roots[i] == roots[j], connected[i][j]);
            }
        }
        EXPECT_EQ(std::set<std::uint32_t>(roots.begin(), roots.end()).size(), count - joined);
    }
}

} // namespace
} // namespace frustumscreen::geometry
