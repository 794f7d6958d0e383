// A level without its never visible triangles, against triangles and eyes chosen by hand.

#include "app/scene/scene_level.h"
#include "tests/render/synthetic_pack.h"
#include "tests/settings/steep_table.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>
#include <set>

namespace frustumscreen::synthetic {
namespace {

using Corner = std::array<std::uint16_t, 3>;
using Triangle = std::array<Corner, 3>;

std::vector<Triangle> triangles_in(const pack::PackLevel& level) {
    std::vector<Triangle> triangles;
    for (std::size_t k = 0; k < level.indices.size(); k += 3) {
        triangles.push_back({level.vertices[level.indices[k]].position,
                             level.vertices[level.indices[k + 1]].position,
                             level.vertices[level.indices[k + 2]].position});
    }
    return triangles;
}

glm::dvec3 metres(const Corner& corner, const pack::Pack& pack, double metres_per_box) {
    const glm::dvec3 unit = glm::dvec3(corner[0], corner[1], corner[2]) / 65535.0;
    return metres_per_box * (unit - glm::dvec3(0.5, 0.5, 0.0)) * pack.box_size;
}

/// Signed height of the eye above the triangle's plane, metres.
double above(const Triangle& triangle, const glm::dvec3& eye, const pack::Pack& pack, double scale) {
    const glm::dvec3 a = metres(triangle[0], pack, scale);
    const glm::dvec3 n =
        glm::cross(metres(triangle[1], pack, scale) - a, metres(triangle[2], pack, scale) - a);
    return glm::dot(glm::normalize(n), eye - a);
}

pack::Pack placed_rings() {
    pack::Pack pack = rings(32, 16);
    for (unsigned k = 0; k < 8; ++k) {
        pack.extremes.emplace_back(((k & 1U) != 0 ? 0.5 : -0.5) * pack.box_size.x,
                                   ((k & 2U) != 0 ? 0.5 : -0.5) * pack.box_size.y,
                                   (k & 4U) != 0 ? pack.box_size.z : 0.0);
    }
    return pack;
}

scene::ScenePlan plan_for(const settings::Settings& settings, const pack::Pack& pack) {
    scene::SceneRequest request;
    request.visibility = scene::visibility_of(settings);
    return scene::plan_scene(settings, pack::outline_of(pack), request).value();
}

TEST(SceneLevel, LosesOnlyTrianglesThatLookAwayFromEveryEyeOfTheZone) {
    const settings::Settings settings = settings::steep_table();
    const pack::Pack pack = placed_rings();
    const scene::ScenePlan plan = plan_for(settings, pack);
    const scene::SceneLevel level = scene::scene_level(pack, 0, plan);
    EXPECT_GT(level.unseen_triangles, 50U); // the rings' undersides
    const std::vector<Triangle> all = triangles_in(pack.levels[0]);
    const std::vector<Triangle> kept = triangles_in(level.mesh);
    EXPECT_EQ(kept.size() + level.unseen_triangles, all.size());

    std::mt19937 random(3);
    std::uniform_real_distribution<double> u(0.0, 1.0);
    std::vector<glm::dvec3> eyes;
    for (int k = 0; k < 400; ++k) { // half of them on the zone's lower edge, where undersides would be
                                    // visible
        const double elevation = glm::radians(k % 2 == 0 ? 15.0 : 15.0 + 75.0 * u(random));
        const double azimuth = glm::radians(360.0 * u(random));
        eyes.push_back((0.35 + 1.65 * u(random)) * glm::dvec3(std::cos(elevation) * std::cos(azimuth),
                                                              std::cos(elevation) * std::sin(azimuth),
                                                              std::sin(elevation)));
    }
    std::size_t next = 0;
    std::size_t seen = 0;
    for (const Triangle& triangle : all) { // kept triangles stay in order
        const bool is_kept = next < kept.size() && kept[next] == triangle;
        next += is_kept ? 1 : 0;
        double most = -1e9;
        for (const glm::dvec3& eye : eyes) {
            most = std::max(most, above(triangle, eye, pack, plan.metres_per_box));
        }
        if (!is_kept) {
            EXPECT_LT(most, 0.0);
        }
        seen += is_kept && most > 0.0 ? 1 : 0;
    }
    EXPECT_EQ(next, kept.size());
    EXPECT_GT(static_cast<double>(seen), 0.98 * static_cast<double>(kept.size())); // and hardly one is
                                                                                   // superfluous
}

TEST(SceneLevel, KeepsClustersThatCoverItsIndicesAndVerticesThatAreUsed) {
    settings::Settings settings = settings::steep_table();
    settings.eye.tracked = false;
    settings.tracker.kind = settings::TrackerKind::None;
    const pack::Pack pack = placed_rings();
    const scene::SceneLevel level = scene::scene_level(pack, 0, plan_for(settings, pack));
    EXPECT_GT(level.unseen_triangles, pack.levels[0].indices.size() / 3 / 3); // one eye: about half
    EXPECT_GT(level.unseen_clusters, 0U);
    std::uint32_t next = 0;
    for (const pack::PackCluster& cluster : level.mesh.clusters) {
        EXPECT_EQ(cluster.first_index, next);
        EXPECT_GT(cluster.index_count, 0U);
        next += cluster.index_count;
    }
    EXPECT_EQ(next, level.mesh.indices.size());
    const std::set<std::uint32_t> used(level.mesh.indices.begin(), level.mesh.indices.end());
    EXPECT_EQ(used.size(), level.mesh.vertices.size());
    EXPECT_EQ(*used.rbegin() + 1, level.mesh.vertices.size());
}

TEST(SceneLevel, IsCompleteForARecordingOrWithoutCullKinds) {
    settings::Settings settings = settings::steep_table();
    const pack::Pack pack = placed_rings();
    settings.tracker.kind = settings::TrackerKind::Replay;
    EXPECT_EQ(scene::scene_level(pack, 0, plan_for(settings, pack)).mesh.indices, pack.levels[0].indices);
    scene::ScenePlan plan = plan_for(settings::Settings(), pack);
    plan.cull_kinds = 0;
    EXPECT_EQ(scene::scene_level(pack, 0, plan).mesh.indices, pack.levels[0].indices);
}

TEST(MipLevel, IsTheFinestWithoutSkippedTexels) {
    EXPECT_EQ(scene::mip_level(100.0, 200.0), 0);
    EXPECT_EQ(scene::mip_level(200.0, 200.0), 0);
    EXPECT_EQ(scene::mip_level(201.0, 200.0), 1);
    EXPECT_EQ(scene::mip_level(400.0, 200.0), 1);
    EXPECT_EQ(scene::mip_level(401.0, 200.0), 2);
    EXPECT_EQ(scene::mip_level(1e9, 1.0), scene::coarsest_mip_level);
    EXPECT_EQ(scene::mip_level(100.0, 0.0), scene::coarsest_mip_level);
    EXPECT_EQ(scene::mip_level(std::nan(""), 1.0), 0);
}

} // namespace
} // namespace frustumscreen::synthetic
