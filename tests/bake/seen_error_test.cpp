// What eyes see of a level, against geometry that is known.
#include "assets_baked/bake/level.h"
#include "tests/bake/shapes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace frustumscreen {

namespace {

constexpr double radius = 0.5;

/// A pack of one level: the mesh.
Pack pack_of(const SourceMesh& mesh) {
    Pack pack;
    pack.box_size = glm::dvec3(1.0);
    pack.textures = {Image8(4, 4, glm::u8vec4(255))};
    pack.levels = {
        make_level(chart(weld(mesh, mesh.positions), 1.0F / 64.0F), pack.box_size, LevelTechnique::Mesh)};
    return pack;
}

SourceMesh sphere(int rows, double smaller = 0.0) {
    SourceMesh mesh = test::empty_mesh();
    test::add_sphere(mesh, {0, 0, radius}, radius - smaller, rows);
    return mesh;
}

} // namespace

// A sphere that is smaller by d all around is off by d along the normal: by d / cos along the ray, of which the mean over a disc
// of rays is 2 d (all but the rim, where the smaller one is missed).
TEST(SeenError, AlongTheRaysIsTwiceTheDistanceOfConvexSurfaces) {
    constexpr double smaller = 2e-3;
    const SourceMesh source_mesh = sphere(192);
    const SourceScene source(source_mesh, source_mesh.positions);
    const SeenErrors seen = seen_errors(pack_of(sphere(192, smaller)), source, ViewingZone::all_around());
    ASSERT_EQ(seen.levels.size(), 1U);
    ASSERT_EQ(seen.levels[0].size(), seen.eyes.size());
    const SeenError mean = mean_of(seen.levels[0]);
    EXPECT_NEAR(static_cast<double>(mean.mean_box), 2.0 * smaller, 0.15 * smaller);
    // A ray at the share s of the radius is off by d / sqrt(1 - s^2); 95 % of the disc have s^2 < 0.95.
    EXPECT_NEAR(static_cast<double>(mean.p95_box), smaller / std::sqrt(0.05), 0.35 * smaller);
    // The rim is a ring of that width, a share 2 d / r of the disc.
    EXPECT_NEAR(static_cast<double>(mean.silhouette_share), 2.0 * smaller / radius, 0.2 * smaller / radius);
    EXPECT_GT(static_cast<double>(mean.outline_shift_box),
              0.6 * smaller); // steps of a grid's outline are longer than a circle
    EXPECT_LT(static_cast<double>(mean.outline_shift_box), 1.2 * smaller);
    for (std::size_t k = 0; k < seen.eyes.size(); ++k) {
        EXPECT_NEAR(static_cast<double>(seen.levels[0][k].mean_box), 2.0 * smaller, 0.3 * smaller);
        // Along one axis sqrt(1 + slope^2) = sqrt((1 - y^2) / (1 - x^2 - y^2)), pi / 2 in the mean over a disc; the rays of a grid
        // leave out the steepest rim.
        EXPECT_LT(static_cast<double>(seen.eyes[k].steepness), 0.5 * std::numbers::pi);
        EXPECT_GT(static_cast<double>(seen.eyes[k].steepness), 1.35);
        double shares = 0.0;
        glm::dvec3 middle(0.0);
        for (const SeenPatch& patch : seen.eyes[k].patches) {
            shares += patch.share;
            middle += patch.share * patch.place;
        }
        EXPECT_NEAR(shares, 1.0, 1e-6);
        // The middle of a hemisphere over a disc lies 2/3 of the radius towards the eye, which is not at infinity.
        EXPECT_LT(glm::distance(middle, glm::dvec3(0, 0, radius) + 2.0 / 3.0 * radius * seen.eyes[k].towards),
                  0.05);
    }
}

TEST(SeenError, OfTheSourceItselfIsThatOfThePacksCodes) {
    const SourceMesh mesh = sphere(64);
    const SourceScene source(mesh, mesh.positions);
    const SeenErrors seen = seen_errors(pack_of(mesh), source, {});
    for (const SeenError& each : seen.levels[0]) {
        EXPECT_LT(each.mean_box, 2e-5F); // codes are 1.5e-5 apart
        EXPECT_LT(each.silhouette_share, 1e-3F);
    }
}

TEST(SeenError, EyesAreSpreadEvenlyOverTheZone) {
    const SourceMesh mesh = sphere(16);
    const SourceScene source(mesh, mesh.positions);
    const Pack pack = pack_of(mesh);
    glm::dvec3 sum(0.0);
    const SeenErrors around = seen_errors(pack, source, ViewingZone::all_around());
    for (const SeenEye& eye : around.eyes) {
        EXPECT_NEAR(glm::length(eye.towards), 1.0, 1e-12);
        sum += eye.towards;
    }
    EXPECT_LT(glm::length(sum) / static_cast<double>(around.eyes.size()), 0.02);
    for (const SeenEye& eye : seen_errors(pack, source, {}).eyes) {
        EXPECT_GT(eye.towards.z, std::sin(3.0 * std::numbers::pi / 180.0));
    }
}

} // namespace frustumscreen
