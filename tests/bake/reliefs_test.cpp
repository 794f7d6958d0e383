// The reliefs of a pack, compared with a sphere's known geometry.
#include "app/pack/block_part.h"
#include "app/pack/pack_relief.h"
#include "assets_baked/bake/bake.h"
#include "assets_baked/bake/block_relief.h"
#include "assets_baked/bake/measured_reliefs.h"
#include "assets_baked/bake/relief_scene.h"
#include "tests/bake/shapes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace frustumscreen::bake {
namespace {

pack::Pack sphere_pack(int size, bool far) {
    SourceMesh mesh = test::empty_mesh();
    test::add_sphere(mesh, {0, 0, 0.5}, 0.5, 64);
    for (const glm::dvec3& p : mesh.positions) {
        mesh.colours.emplace_back(0.5 + p.x, 0.5 + p.y, p.z, 1.0);
    }
    BakeOptions options;
    options.size = size;
    options.unlit = true;
    options.up = "z";
    options.turn_deg = 0.0;
    options.measuring = 0.25;
    options.far = far;
    return bake(mesh, options).value();
}

TEST(Reliefs, SizesDoubleFrom96TexelsUpToTheBakeSize) {
    EXPECT_EQ(relief_texels(512), (std::vector<int>{96, 192, 384}));
    EXPECT_EQ(relief_texels(1024), (std::vector<int>{96, 192, 384, 768}));
    EXPECT_EQ(relief_texels(96), (std::vector<int>{96}));
    EXPECT_EQ(relief_texels(40), (std::vector<int>{40}));
    EXPECT_EQ(relief_texels(192, true), (std::vector<int>{24, 48, 96, 192})) << "for a room";
    EXPECT_EQ(relief_texels(16, true), (std::vector<int>{16}));
}

TEST(Reliefs, ErrorsOnASphereAreOfTexelSize) {
    const pack::Pack pack = sphere_pack(192, true);
    const std::vector<pack::ReliefOutline> reliefs = pack::reliefs_of(pack).value();
    ASSERT_EQ(reliefs.size(), 4U);
    for (const pack::ReliefOutline& outline : reliefs) {
        const relief::BlockRelief relief = pack::relief_of(pack, outline).value();
        EXPECT_EQ(relief.grids.size(), 5U) << "a frustum's";
        double worst = 0.0;
        for (const glm::vec3& point : surface_of(relief).positions) {
            worst = std::max(worst, std::abs(glm::distance(glm::dvec3(point), {0.0, 0.0, 0.5}) - 0.5));
        }
        std::printf("%u texels: off the sphere by %.2e at most; mean %.2e, p95 %.2e, max %.2e, colour %.2f\n",
                    outline.texels, worst, static_cast<double>(outline.error.mean_box),
                    static_cast<double>(outline.error.p95_box), static_cast<double>(outline.error.max_box),
                    static_cast<double>(outline.error.colour_rmse));
        // The sphere's own triangles deviate from it by 1 - cos(pi / 64) of its radius.
        EXPECT_LT(worst, 2.0 / outline.texels);
        EXPECT_LT(outline.error.p95_box, 0.5F / static_cast<float>(outline.texels));
        EXPECT_LT(outline.error.max_box, 2.0F / static_cast<float>(outline.texels));
        EXPECT_LT(outline.error.colour_rmse, std::max(2.0F, 64.0F / static_cast<float>(outline.texels)));
    }
    EXPECT_LT(reliefs[1].error.mean_box, reliefs[0].error.mean_box);
}

/// Triangles without shared vertices that overlap their neighbours cannot be simplified, so a slow machine draws the
/// reliefs.
TEST(Reliefs, AreSmallerThanTheLevelsOfATriangleSoup) {
    SourceMesh sphere = test::empty_mesh();
    test::add_sphere(sphere, {0, 0, 0.5}, 0.5, 86);
    SourceMesh soup = test::empty_mesh();
    std::mt19937 random(11);
    std::uniform_real_distribution<double> jitter(-2e-4, 2e-4);
    for (const auto& triangle : sphere.triangles) {
        const auto first = static_cast<std::uint32_t>(soup.positions.size());
        const glm::dvec3 centre =
            (sphere.positions[triangle[0]] + sphere.positions[triangle[1]] + sphere.positions[triangle[2]]) /
            3.0;
        for (const std::uint32_t vertex : triangle) {
            const glm::dvec3 grown = centre + 1.2 * (sphere.positions[vertex] - centre);
            soup.positions.push_back(grown + glm::dvec3(jitter(random), jitter(random), jitter(random)));
        }
        test::add_triangle(soup, first, first + 1, first + 2);
    }
    BakeOptions options;
    options.size = 96;
    options.unlit = true;
    options.measuring = 0.1;
    options.up = "z";
    const pack::Pack pack = bake(soup, options).value();
    const std::vector<pack::ReliefOutline> reliefs = pack::reliefs_of(pack).value();
    ASSERT_FALSE(reliefs.empty());
    EXPECT_GT(pack.levels.front().indices.size() / 3, soup.triangles.size() / 2);
    EXPECT_LT(reliefs.front().blocks, soup.triangles.size() / 2);
    EXPECT_LT(reliefs.front().error.mean_box, 3e-3F);
    EXPECT_TRUE(pack.relief.charts.empty()) << "no relief as a mesh";
}

/// A sheet of no thickness with both sides kept: both sides' cells are at one place, and each is visible from one side.
/// A ray that passes the back of one hits the front of the other.
TEST(Reliefs, RaysHitASheetFromEitherSide) {
    SourceMesh sheet = test::empty_mesh();
    sheet.positions = {{-0.5, 0.0, 0.0}, {0.5, 0.0, 0.0}, {0.5, 0.0, 1.0}, {-0.5, 0.0, 1.0}};
    test::add_triangle(sheet, 0, 1, 2);
    test::add_triangle(sheet, 0, 2, 3);
    test::add_triangle(sheet, 0, 2, 1);
    test::add_triangle(sheet, 0, 3, 2);
    const SourceScene source(sheet, sheet.positions, Sides::Front);
    const relief::BlockRelief relief = bake_blocks(
        {source, {1.0, 0.1, 1.0}, {pack::ReliefDirection::PlusY, pack::ReliefDirection::MinusY}, 48});
    const ReliefScene drawn(relief);
    constexpr int rays = 100;
    for (const float side : {1.0F, -1.0F}) {
        int missing = 0;
        for (int z = 0; z < rays; ++z) {
            for (int x = 0; x < rays; ++x) {
                const glm::vec3 from(0.96F * ((static_cast<float>(x) + 0.5F) / rays - 0.5F), 2.0F * side,
                                     0.02F + 0.96F * (static_cast<float>(z) + 0.5F) / rays);
                missing += drawn.trace(from, {0.0F, -side, 0.0F}).hit ? 0 : 1;
            }
        }
        EXPECT_EQ(missing, 0) << side;
    }
}

} // namespace
} // namespace frustumscreen::bake
