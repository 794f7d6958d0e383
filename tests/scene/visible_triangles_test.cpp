#include "app/scene/visible_triangles.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace frustumscreen::scene {
namespace {

/// One cluster of triangles scattered over the unit box.
LevelTriangles scattered(std::mt19937& random, int triangles) {
    std::uniform_int_distribution<int> code(0, 65535);
    pack::PackLevel level;
    for (int k = 0; k < 3 * triangles; ++k) {
        pack::PackVertex vertex;
        for (std::uint16_t& axis : vertex.position) {
            axis = static_cast<std::uint16_t>(code(random));
        }
        level.vertices.push_back(vertex);
        level.indices.push_back(static_cast<std::uint32_t>(k));
    }
    pack::PackCluster all;
    all.index_count = static_cast<std::uint32_t>(level.indices.size());
    all.centre = {0.0F, 0.0F, 0.5F};
    all.radius = 0.87F;
    level.clusters = {all};
    return triangles_of(level, glm::dvec3(1.0));
}

std::vector<std::uint32_t> visible(const FaceVolume& volume, const glm::dvec3& eye,
                                   const LevelTriangles& level) {
    std::vector<std::uint32_t> indices;
    FrontTriangles front;
    front.update(level, eye);
    for (std::size_t cluster = 0; cluster < level.clusters.size(); ++cluster) {
        append_visible(volume, level, front, cluster, indices, 0.0);
    }
    return indices;
}

TEST(VisibleTriangles, AreThoseThatFaceTheEyeAndReachIntoTheVolume) {
    std::mt19937 random(3);
    std::normal_distribution<double> n(0.0, 1.0);
    std::size_t all_shown = 0;
    for (int round = 0; round < 20; ++round) {
        const LevelTriangles level = scattered(random, 500);
        FaceVolume volume;
        const glm::dvec3 eye = glm::dvec3(n(random), n(random), n(random)) * 3.0;
        for (int plane = 0; plane < 3; ++plane) {
            volume.add({n(random), n(random), n(random), 0.3});
        }
        const std::vector<std::uint32_t> indices = visible(volume, eye, level);
        std::size_t at = 0;
        for (std::uint32_t first = 0; first < 1500; first += 3) {
            const std::array<glm::dvec3, 3> corner{level.positions[first], level.positions[first + 1],
                                                   level.positions[first + 2]};
            const double facing = glm::dot(
                glm::normalize(glm::cross(corner[1] - corner[0], corner[2] - corner[0])), eye - corner[0]);
            double deepest = 1e9; // signed depth in the half space that contains the triangle least
            for (std::size_t k = 0; k < volume.count; ++k) {
                double most = -1e9;
                for (const glm::dvec3& c : corner) {
                    most = std::max(most,
                                    glm::dot(glm::dvec3(volume.half_spaces[k]), c) + volume.half_spaces[k].w);
                }
                deepest = std::min(deepest, most);
            }
            if (std::abs(facing) < 1e-4 || std::abs(deepest) < 1e-5) {
                at += at < indices.size() && indices[at] == first ? 3U : 0U; // both answers are correct
                continue;
            }
            const bool shown = at < indices.size() && indices[at] == first;
            ASSERT_EQ(shown, facing > 0.0 && deepest > 0.0) << "triangle " << first / 3;
            at += shown ? 3U : 0U;
        }
        EXPECT_EQ(at, indices.size());
        all_shown += indices.size() / 3;
    }
    EXPECT_GT(all_shown, 500U);
}

/// A triangle in the plane z = 0.5, facing up, in a cluster with the given bounding sphere.
LevelTriangles one_triangle(const glm::vec3& centre, float radius) {
    LevelTriangles level;
    level.positions = {{0.0F, 0.0F, 0.5F}, {0.1F, 0.0F, 0.5F}, {0.0F, 0.1F, 0.5F}};
    level.indices = {0, 1, 2};
    level.normal_x = {0.0F};
    level.normal_y = {0.0F};
    level.normal_z = {1.0F};
    level.distance = {0.5F};
    pack::PackCluster cluster;
    cluster.index_count = 3;
    cluster.centre = centre;
    cluster.radius = radius;
    level.clusters = {cluster};
    return level;
}

TEST(VisibleTriangles, AClusterOutsideIsLeftOutWhole) {
    FaceVolume volume;
    volume.add({0.0, 0.0, 4.0, -2.0}); // z >= 0.5
    EXPECT_EQ(visible(volume, {0, 0, 3}, one_triangle({0.0F, 0.0F, 0.45F}, 0.2F)).size(), 3U);
    EXPECT_TRUE(visible(volume, {0, 0, 3}, one_triangle({0.0F, 0.0F, 0.29F}, 0.2F)).empty());
}

TEST(VisibleTriangles, ABackFacingConeIsLeftOutWhole) {
    LevelTriangles level = one_triangle({0.0F, 0.0F, 0.5F}, 0.2F);
    level.clusters[0].cone_axis = {0, 0, 1};
    level.clusters[0].cone_cutoff = 0.5F;
    FaceVolume volume;
    EXPECT_EQ(visible(volume, {0, 0, 3}, level).size(), 3U);
    level.clusters[0].cone_axis = {0, 0, -1}; // parallel to apex - eye
    EXPECT_TRUE(visible(volume, {0, 0, 3}, level).empty());
}

TEST(VisibleTriangles, ADegenerateHalfSpaceHidesNothing) {
    FaceVolume volume;
    volume.add({0.0, 0.0, 0.0, -1.0});
    volume.add({std::nan(""), 0.0, 0.0, -1.0});
    EXPECT_EQ(volume.count, 0U);
}

} // namespace
} // namespace frustumscreen::scene
