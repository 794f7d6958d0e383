#include "app/geometry/triangle_tree.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace frustumscreen::geometry {
namespace {

struct Soup {
    std::vector<glm::vec3> positions;
    std::vector<std::uint32_t> indices;
};

using Exact = glm::tvec3<long double>;

/// Six times the signed volume of a tetrahedron.
long double volume(const Exact& a, const Exact& b, const Exact& c, const Exact& d) {
    return glm::dot(glm::cross(b - a, c - a), d - a);
}

enum class Meets { No, Yes, TooClose };

/// Uses only signs of volumes, unlike the tree.
Meets meets(const std::array<Exact, 3>& t, const Exact& from, const Exact& to) {
    const long double begin = volume(t[0], t[1], t[2], from);
    const long double end = volume(t[0], t[1], t[2], to);
    const std::array<long double, 3> sides{volume(from, to, t[0], t[1]), volume(from, to, t[1], t[2]),
                                           volume(from, to, t[2], t[0])};
    constexpr long double rounding = 1e-7L;
    long double least = std::min(std::abs(begin), std::abs(end));
    for (const long double side : sides) {
        least = std::min(least, std::abs(side));
    }
    const bool through =
        (sides[0] > 0 && sides[1] > 0 && sides[2] > 0) || (sides[0] < 0 && sides[1] < 0 && sides[2] < 0);
    const bool between = (begin > 0) != (end > 0);
    return least < rounding ? Meets::TooClose : through && between ? Meets::Yes : Meets::No;
}

Meets meets_any(const Soup& soup, const Exact& from, const Exact& to) {
    Meets all = Meets::No;
    for (std::size_t k = 0; k < soup.indices.size(); k += 3) {
        const Meets one =
            meets({Exact(soup.positions[soup.indices[k]]), Exact(soup.positions[soup.indices[k + 1]]),
                   Exact(soup.positions[soup.indices[k + 2]])},
                  from, to);
        if (one == Meets::Yes) {
            return Meets::Yes;
        }
        all = one == Meets::TooClose ? one : all;
    }
    return all;
}

TEST(TriangleTree, MeetsASegmentExactlyWhereSomeTriangleDoes) {
    std::mt19937_64 random(5);
    std::uniform_real_distribution<float> place(-1.0F, 1.0F);
    std::uniform_real_distribution<float> near(-0.25F, 0.25F);
    int hits = 0;
    int misses = 0;
    int too_close = 0;
    for (const int count : {1, 2, 5, 17, 200, 600}) {
        Soup soup;
        for (int k = 0; k < count; ++k) {
            const glm::vec3 middle(place(random), place(random), place(random));
            for (int corner = 0; corner < 3; ++corner) {
                soup.indices.push_back(static_cast<std::uint32_t>(soup.positions.size()));
                soup.positions.push_back(middle + glm::vec3(near(random), near(random), near(random)));
            }
        }
        const TriangleTree tree(soup.positions, soup.indices);
        for (int k = 0; k < 2000; ++k) {
            const glm::dvec3 from(2.0F * glm::vec3(place(random), place(random), place(random)));
            glm::dvec3 to(glm::vec3(place(random), place(random), place(random)));
            if (k % 8 == 0) {
                to[k / 8 % 3] = from[k / 8 % 3]; // parallel to a slab
            }
            const Meets expected = meets_any(soup, Exact(from), Exact(to));
            too_close += expected == Meets::TooClose ? 1 : 0;
            if (expected != Meets::TooClose) {
                EXPECT_EQ(tree.meets(from, to), expected == Meets::Yes);
                (expected == Meets::Yes ? hits : misses) += 1;
            }
        }
    }
    EXPECT_GT(hits, 2000);
    EXPECT_GT(misses, 2000);
    EXPECT_LT(too_close, 200);
}

/// A closed surface of many small triangles has no holes, also where rays pass through edges and corners.
TEST(TriangleTree, ASphereHasNoHoles) {
    Soup sphere;
    constexpr int rings = 64;
    constexpr int spokes = 128;
    for (int ring = 0; ring <= rings; ++ring) {
        for (int spoke = 0; spoke < spokes; ++spoke) {
            const double polar = 3.14159265358979 * ring / rings;
            const double azimuth = 2.0 * 3.14159265358979 * spoke / spokes;
            sphere.positions.emplace_back(std::sin(polar) * std::cos(azimuth),
                                          std::sin(polar) * std::sin(azimuth), std::cos(polar));
        }
    }
    for (std::uint32_t ring = 0; ring < rings; ++ring) {
        for (std::uint32_t spoke = 0; spoke < spokes; ++spoke) {
            const std::uint32_t a = ring * spokes + spoke;
            const std::uint32_t b = ring * spokes + (spoke + 1) % spokes;
            sphere.indices.insert(sphere.indices.end(), {a, a + spokes, b, b, a + spokes, b + spokes});
        }
    }
    const TriangleTree tree(sphere.positions, sphere.indices);
    for (const glm::vec3& corner : sphere.positions) {
        const glm::dvec3 far = 2.0 * glm::dvec3(corner);
        EXPECT_TRUE(tree.meets(far, glm::dvec3(0.0)));
        EXPECT_TRUE(tree.meets(glm::dvec3(0.0), far));
        EXPECT_FALSE(tree.meets(far, 1.0001 * glm::dvec3(corner)));
        EXPECT_FALSE(tree.meets(glm::dvec3(0.0), 0.99 * glm::dvec3(corner)));
    }
}

TEST(TriangleTree, EmptyTreeAndDegenerateTrianglesMeetNothing) {
    EXPECT_FALSE(TriangleTree().meets({0, 0, 1}, {0, 0, -1}));
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const std::vector<glm::vec3> positions{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {nan, 0, 0}, {0, 1, 0}};
    const std::vector<std::uint32_t> indices{0, 1, 2, 0, 1, 3, 0, 0, 4, 0, 1};
    const TriangleTree tree(positions, indices);
    EXPECT_FALSE(tree.meets({0.5, 0, 1}, {0.5, 0, -1}));
}

} // namespace
} // namespace frustumscreen::geometry
