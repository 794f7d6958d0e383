// Shadow maps against rays: each pixel's ray and each triangle, in 64 bits, without rounding to parts of a pixel.

#include "app/torch/shadow_map.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <vector>

namespace frustumscreen::torch {
namespace {

constexpr int side_px = 64;
constexpr double focal_px = 60.0;

/// The torch's frame is the model's.
ShadowMap::View straight(double metres = 1.0) {
    return {.picture_from_model =
                glm::dmat4x3(glm::dvec3(focal_px, 0.0, 0.0), glm::dvec3(0.0, focal_px, 0.0),
                             glm::dvec3(0.5 * side_px, 0.5 * side_px, 1.0), glm::dvec3(0.0)),
            .metres = metres};
}
glm::dvec3 ray_of(double x, double y) {
    return {(x - 0.5 * side_px) / focal_px, (y - 0.5 * side_px) / focal_px, 1.0};
}

struct Mesh {
    std::vector<glm::vec3> positions;
    std::vector<std::uint32_t> indices;

    void add(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) {
        for (const glm::vec3& corner : {a, b, c}) {
            indices.push_back(static_cast<std::uint32_t>(positions.size()));
            positions.push_back(corner);
        }
    }
};

/// The nearest triangle's 1 / z on a ray, 0 without a hit. `wider`: the triangle grows by that share of itself, or shrinks.
double nearness_on(const Mesh& mesh, const glm::dvec3& ray, double wider) {
    double nearest = 0.0;
    for (std::size_t k = 0; k < mesh.indices.size(); k += 3) {
        const glm::dvec3 a(mesh.positions[mesh.indices[k]]);
        const glm::dvec3 b(mesh.positions[mesh.indices[k + 1]]);
        const glm::dvec3 c(mesh.positions[mesh.indices[k + 2]]);
        const double of_a = glm::dot(ray, glm::cross(b, c));
        const double of_b = glm::dot(ray, glm::cross(c, a));
        const double of_c = glm::dot(ray, glm::cross(a, b));
        const double volume = glm::dot(a, glm::cross(b, c));
        const double least = -wider * (std::fabs(of_a) + std::fabs(of_b) + std::fabs(of_c));
        const double sign = volume < 0.0 ? -1.0 : 1.0;
        if (sign * of_a >= least && sign * of_b >= least && sign * of_c >= least && volume != 0.0) {
            const double nearness = (of_a + of_b + of_c) / volume; // 1 / z
            nearest = nearness < 1e4 ? std::max(nearest, nearness) : nearest;
        }
    }
    return nearest;
}

ShadowMap map_of(const Mesh& mesh, const ShadowMap::View& view = straight()) {
    ShadowMap map;
    map.begin(side_px, side_px);
    map.draw(view, mesh.positions, mesh.indices);
    return map;
}
double at(const ShadowMap& map, int x, int y) {
    return static_cast<double>(map.nearness()[static_cast<std::size_t>(y * side_px + x)]);
}

/// Each pixel lies between what rays near its middle meet: a corner moves by up to 1/512 of a pixel.
std::size_t count_wrong(const ShadowMap& map, const Mesh& mesh) {
    constexpr double near_px = 1.0 / 256.0;
    std::size_t wrong = 0;
    for (int y = 0; y < side_px; ++y) {
        for (int x = 0; x < side_px; ++x) {
            double low = std::numeric_limits<double>::infinity();
            double high = 0.0;
            for (int k = 0; k < 9; ++k) {
                const glm::dvec3 ray =
                    ray_of(x + 0.5 + near_px * (k % 3 - 1), y + 0.5 + near_px * (k / 3 - 1));
                low = std::min(low, nearness_on(mesh, ray, -1e-6));
                high = std::max(high, nearness_on(mesh, ray, 1e-6));
            }
            const double found = at(map, x, y);
            wrong += found < low * (1.0 - 1e-4) || found > high * (1.0 + 1e-4) ? 1U : 0U;
        }
    }
    return wrong;
}

TEST(ShadowMap, HasTheNearestTriangleOfEachPixel) {
    std::mt19937 random(48);
    std::uniform_real_distribution<float> aside(-0.6F, 0.6F);
    std::uniform_real_distribution<float> deep(0.3F, 1.4F);
    for (const float size : {0.02F, 0.2F, 1.0F}) {
        Mesh mesh;
        for (int k = 0; k < 60; ++k) {
            const float z = deep(random);
            const glm::vec3 middle(z * aside(random), z * aside(random), z);
            const auto corner = [&] {
                return middle + size * glm::vec3(aside(random), aside(random), 0.25F * aside(random));
            };
            mesh.add(corner(), corner(), corner());
        }
        const ShadowMap map = map_of(mesh);
        EXPECT_GT(
            std::count_if(map.nearness().begin(), map.nearness().end(), [](float n) { return n > 0.0F; }),
            10);
        EXPECT_EQ(count_wrong(map, mesh), 0U) << size;
    }
}

TEST(ShadowMap, ClipsTrianglesBehindOrFarBesideTheTorch) {
    std::mt19937 random(5);
    std::uniform_real_distribution<float> place(-1.0F, 1.0F);
    for (const float far : {1.0F, 3000.0F}) {
        for (int k = 0; k < 40; ++k) {
            Mesh mesh;
            mesh.add({far * place(random), far * place(random), place(random)},
                     {far * place(random), far * place(random), place(random)},
                     {far * place(random), far * place(random), 1.0F});
            EXPECT_EQ(count_wrong(map_of(mesh), mesh), 0U) << far << ' ' << k;
        }
    }
}

/// A wall of triangles in which every pixel's middle lies on an edge or a corner.
TEST(ShadowMap, HasNoGapsBetweenTriangles) {
    Mesh wall;
    constexpr int cells = side_px;
    for (int y = 0; y <= cells; ++y) {
        for (int x = 0; x <= cells; ++x) {
            wall.positions.emplace_back(ray_of(x + 0.5, y + 0.5));
        }
    }
    for (int y = 0; y < cells; ++y) {
        for (int x = 0; x < cells; ++x) {
            const auto first = static_cast<std::uint32_t>(y * (cells + 1) + x);
            for (const std::uint32_t corner : {0U, 1U, cells + 2U, 0U, cells + 2U, cells + 1U}) {
                wall.indices.push_back(first + corner);
            }
        }
    }
    const ShadowMap map = map_of(wall, straight(0.5));
    for (int y = 0; y < side_px; ++y) {
        for (int x = 0; x < side_px; ++x) {
            EXPECT_NEAR(at(map, x, y), 0.5, 1e-6) << x << ' ' << y;
        }
    }
}

/// A sheet whose front, or whose back, looks at the torch at a depth.
Mesh sheet(bool front, float depth) {
    Mesh mesh;
    mesh.add({-1.0F, -1.0F, depth}, {0.0F, 1.0F, depth}, {1.0F, -1.0F, depth}); // its normal is (0, 0, -1)
    if (!front) {
        std::swap(mesh.indices[1], mesh.indices[2]);
    }
    return mesh;
}

/// Where the first surface is a back, the torch is inside an object, also in a view that mirrors; a back behind a front is
/// the far side of a wall that the torch is outside of.
TEST(ShadowMap, IsDarkWhereTheFirstSurfaceIsABack) {
    constexpr double slack = 0.001;
    const auto first = [&](double sign, std::initializer_list<Mesh> meshes) {
        ShadowMap::View view = straight();
        view.picture_from_model[0] *= sign;
        view.from_within = true;
        ShadowMap map;
        map.begin(side_px, side_px);
        for (const Mesh& mesh : meshes) {
            map.draw(view, mesh.positions, mesh.indices);
        }
        map.end(slack);
        map.find_farthest();
        return static_cast<double>(map.farthest()[std::size_t{32} * side_px + 32].of_four);
    };
    for (const double sign : {1.0, -1.0}) {
        EXPECT_NEAR(first(sign, {sheet(true, 0.8F)}), 1.25, 1e-6);
        EXPECT_GT(first(sign, {sheet(false, 0.8F)}), 1e6);
        EXPECT_GT(first(sign, {sheet(true, 1.0F), sheet(false, 0.8F)}), 1e6);
        EXPECT_NEAR(first(sign, {sheet(false, 1.0F), sheet(true, 0.8F)}), 1.25, 1e-6);
        EXPECT_NEAR(first(sign, {sheet(true, 0.8F), sheet(false, 0.8F)}), 1.25, 1e-6) << "on an outline";
    }
}

/// Each is no nearer than the farthest of the four, or of those that a place away from the farthest lies between, and no farther than
/// that by more than a slack; as far as half of their range.
TEST(ShadowMap, FindsTheFarthestOfFourAndOfThree) {
    constexpr double slack = 0.001;
    Mesh mesh;
    mesh.add({-0.2F, -0.3F, 0.8F}, {0.3F, -0.1F, 1.1F}, {0.0F, 0.4F, 0.9F});
    const ShadowMap own = map_of(mesh);
    ShadowMap map = own;
    map.end(slack);
    map.find_farthest();
    int apart = 0;
    for (int y = 0; y + 1 < side_px; ++y) {
        for (int x = 0; x + 1 < side_px; ++x) {
            const std::array four{at(own, x, y), at(own, x + 1, y), at(own, x, y + 1), at(own, x + 1, y + 1)};
            std::array sorted = four;
            std::ranges::sort(sorted);
            const auto lowered = [&](double low) {
                return std::max(low * (1.0 - slack), low - 0.5 * (sorted.back() - low));
            };
            const ShadowMap::Farthest& farthest = map.farthest()[static_cast<std::size_t>(y * side_px + x)];
            EXPECT_NEAR(farthest.of_four, lowered(sorted[0]), 1e-6);
            EXPECT_NEAR(farthest.without_one, lowered(sorted[1]), 2e-6);
            if (sorted[0] < sorted[1]) {
                ++apart;
                EXPECT_EQ(four.at(std::bit_cast<std::uint32_t>(farthest.without_one) & 3U), sorted[0]);
            }
        }
    }
    EXPECT_GT(apart, 100);
}

TEST(ShadowMap, IgnoresNonFiniteTrianglesAndTrianglesBehindIt) {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const float infinite = std::numeric_limits<float>::infinity();
    for (const float odd : {nan, infinite, -infinite}) {
        for (int axis = 0; axis < 3; ++axis) {
            Mesh mesh;
            mesh.add({-1.0F, -1.0F, 1.0F}, {1.0F, -1.0F, 1.0F}, {0.0F, 1.0F, 1.0F});
            mesh.positions[1][axis] = odd;
            const ShadowMap map = map_of(mesh);
            EXPECT_EQ(std::ranges::count(map.nearness(), 0.0F), side_px * side_px);
        }
    }
    Mesh behind;
    behind.add({-1.0F, -1.0F, -1.0F}, {1.0F, -1.0F, -1.0F}, {0.0F, 1.0F, -0.5F});
    EXPECT_EQ(std::ranges::count(map_of(behind).nearness(), 0.0F), side_px * side_px);
}

} // namespace
} // namespace frustumscreen::torch
