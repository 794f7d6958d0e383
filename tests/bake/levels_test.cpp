#include "assets_baked/bake/bake.h"
#include "assets_baked/bake/box_frame.h"
#include "assets_baked/bake/level.h"
#include "assets_baked/bake/level_choice.h"
#include "tests/bake/shapes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

namespace frustumscreen::bake {

namespace {

BakeOptions quick(bool unlit = true) {
    BakeOptions options;
    options.relief = false;
    options.size = 64;
    options.unlit = unlit;
    options.measuring = 0.1;
    return options;
}

pack::LevelOutline level_of(std::uint64_t triangles, float mean_box, float p95_box) {
    pack::LevelOutline level;
    level.triangles = triangles;
    level.error.mean_box = mean_box;
    level.error.p95_box = p95_box;
    return level;
}

} // namespace

TEST(Levels, FrontRunsFromTheCheapestToTheMostExact) {
    const std::vector<pack::LevelOutline> levels{
        level_of(40'000, 1e-4F, 3e-4F), level_of(10'000, 4e-4F, 9e-4F),
        level_of(20'000, 5e-4F, 9e-4F), // more costly, and not more exact
        level_of(30'000, 2e-4F, 2e-3F), // a smaller mean error, but a larger 95th percentile
        level_of(2'000, 1e-3F, 3e-3F),
    };
    EXPECT_EQ(measured_front(levels), (std::vector<std::size_t>{4, 1, 0}));
}

TEST(Levels, OnlyTheMostExactSmallLevelIsOnTheFront) {
    const std::vector<pack::LevelOutline> levels{
        level_of(1'000, 5e-4F, 9e-4F),
        level_of(10, 2e-3F, 5e-3F), // as costly for a frame as the first
        level_of(1'200, 5e-4F, 9e-4F),
        level_of(8'000, 1e-4F, 2e-4F),
    };
    EXPECT_EQ(measured_front(levels), (std::vector<std::size_t>{0, 3}));
}

TEST(Levels, MeasuredErrorOfACoarseSphereIsItsSagitta) {
    SourceMesh fine = test::empty_mesh();
    test::add_sphere(fine, {0, 0, 0.5}, 0.5, 256);
    SourceMesh coarse = test::empty_mesh();
    constexpr int rows = 16;
    test::add_sphere(coarse, {0, 0, 0.5}, 0.5, rows);
    const SourceScene source(fine, fine.positions);
    const TriangleMesh surface = weld(coarse, coarse.positions);
    const pack::PackLevel level = make_level(chart(surface, 1.0F / 64.0F), glm::dvec3(1.0));
    const SourceSamples samples = sample_source(source, weld(fine, fine.positions), 0.1F);
    const pack::LevelError error =
        measure(level, image::Image8(4, 4), glm::dvec3(1.0), source, samples, false);
    // A quad spans 180/16 degrees each way; its centre lies r (1 - cos(half)^2) below the sphere.
    const double half = std::numbers::pi / rows / 2.0;
    EXPECT_NEAR(error.max_box, 0.5 * (1.0 - std::cos(half) * std::cos(half)), 4e-4);
    EXPECT_GT(error.mean_box, 0.2F * error.max_box);
    EXPECT_LT(error.mean_box, 0.7F * error.max_box);
}

TEST(Levels, ClustersCoverAllTrianglesOnceAndBoundThem) {
    SourceMesh mesh = test::empty_mesh();
    test::add_sphere(mesh, {0, 0, 0.5}, 0.5, 48);
    const pack::PackLevel level =
        make_level(chart(weld(mesh, mesh.positions), 1.0F / 64.0F), glm::dvec3(1.0));
    const TriangleMesh surface = surface_of(level, glm::dvec3(1.0));
    std::uint32_t next = 0;
    for (const pack::PackCluster& cluster : level.clusters) {
        EXPECT_EQ(cluster.first_index, next);
        next += cluster.index_count;
        for (std::uint32_t k = cluster.first_index; k < next; ++k) {
            EXPECT_LE(glm::distance(surface.positions[level.indices[k]], cluster.centre), cluster.radius);
        }
    }
    EXPECT_EQ(next, level.indices.size());
}

TEST(Levels, AConeCulledClusterFacesAwayFromTheEye) {
    SourceMesh mesh = test::empty_mesh();
    test::add_sphere(mesh, {0, 0, 0.5}, 0.5, 48);
    const pack::PackLevel level =
        make_level(chart(weld(mesh, mesh.positions), 1.0F / 64.0F), glm::dvec3(1.0));
    const TriangleMesh surface = surface_of(level, glm::dvec3(1.0));
    std::mt19937 random(5);
    std::normal_distribution<float> normal;
    int culled = 0;
    for (int round = 0; round < 300; ++round) {
        const glm::vec3 eye = glm::normalize(glm::vec3(normal(random), normal(random), normal(random))) *
                              (0.8F + static_cast<float>(round) * 0.03F);
        for (const pack::PackCluster& cluster : level.clusters) {
            if (glm::dot(glm::normalize(cluster.cone_apex - eye), cluster.cone_axis) < cluster.cone_cutoff) {
                continue;
            }
            ++culled;
            for (std::uint32_t t = cluster.first_index / 3;
                 t < (cluster.first_index + cluster.index_count) / 3; ++t) {
                EXPECT_LE(glm::dot(surface.area_normal(t), eye - surface.corner(t, 0)), 1e-7F);
            }
        }
    }
    EXPECT_GT(culled, 1000);
}

TEST(Levels, ACubesPackHasTheUndersideAndAFrustumsHasNot) {
    SourceMesh mesh = test::empty_mesh();
    test::add_sphere(mesh, {0, 0, 0.5}, 0.5, 44); // one row is 0.4 mm above the bottom
    for (glm::dvec3& position : mesh.positions) {
        position.z = std::max(position.z, 0.2); // a flat bottom
    }
    const auto looking_down = [&](const BakedProp& prop) {
        BakeOptions options = quick();
        options.prop = prop;
        options.up = "z";
        const pack::Pack pack = bake(mesh, options).value();
        EXPECT_EQ(pack.prop_kind, prop.kind);
        const TriangleMesh surface = surface_of(pack.levels.back(), pack.box_size);
        double area = 0.0;
        for (std::uint32_t t = 0; t < surface.triangle_count(); ++t) {
            const glm::vec3 normal = surface.area_normal(t);
            area += normal.z < -0.999F * glm::length(normal) ? -0.5 * normal.z : 0.0;
        }
        return area;
    };
    constexpr double bottom = std::numbers::pi * (0.5 * 0.5 - 0.3 * 0.3); // except for part of a row
    EXPECT_NEAR(looking_down(baked_cube()), bottom, 0.1 * bottom);
    EXPECT_LT(looking_down(baked_frustum()), 0.2 * bottom); // only a rim of it
}

TEST(Levels, ErrorFallsAsCostGrowsAlongTheFront) {
    SourceMesh mesh = test::empty_mesh();
    test::add_sphere(mesh, {0, 0, 0.5}, 0.5, 64);
    const Result<pack::Pack> pack = bake(mesh, quick());
    ASSERT_TRUE(pack);
    ASSERT_GE(pack->levels.size(), 3U);
    for (std::size_t k = 1; k < pack->levels.size(); ++k) {
        EXPECT_GT(pack->levels[k].indices.size(), pack->levels[k - 1].indices.size());
        EXPECT_LT(pack->levels[k].error.mean_box, pack->levels[k - 1].error.mean_box);
    }
}

TEST(Levels, TheSameObjectAtAnyScaleAndPlaceGivesTheSameLevels) {
    std::size_t triangles = 0;
    for (const double scale : {1.0, 1e-3, 1e3}) {
        SourceMesh mesh = test::empty_mesh();
        test::add_sphere(mesh, glm::dvec3(300.0, -20.0, 77.0) * scale, 0.5 * scale, 32);
        const Result<pack::Pack> pack = bake(mesh, quick());
        ASSERT_TRUE(pack);
        EXPECT_NEAR(pack->box_size.x, 1.0, 1e-3);
        if (triangles == 0) {
            triangles = pack->levels.back().indices.size();
        }
        EXPECT_NEAR(static_cast<double>(pack->levels.back().indices.size()), static_cast<double>(triangles),
                    0.02 * static_cast<double>(triangles));
    }
}

TEST(Levels, RepeatedAndDegenerateTrianglesMakeAValidPack) {
    SourceMesh mesh = test::empty_mesh();
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 0, 1}, {0.5, 1e-9, 0.5}};
    test::add_triangle(mesh, 0, 1, 2);
    test::add_triangle(mesh, 0, 1, 2); // repeated
    test::add_triangle(mesh, 1, 0, 2); // flipped
    test::add_triangle(mesh, 1, 1, 2); // degenerate
    test::add_triangle(mesh, 0, 1, 3); // a sliver on top
    BakeOptions options = quick();
    options.up = "z";
    const Result<pack::Pack> pack = bake(mesh, options);
    ASSERT_TRUE(pack) << pack.error().message;
    EXPECT_GE(pack->levels.front().indices.size(), 6U); // both sides are seen
    EXPECT_LT(pack->levels[pack->default_level].error.max_box, 0.05F);
}

TEST(Levels, ATextureKeepsItsColours) {
    SourceMesh mesh = test::empty_mesh();
    test::add_sphere(mesh, {0, 0, 0.5}, 0.5, 32);
    for (const glm::dvec3& p : mesh.positions) { // smooth vertex colours replace a texture
        mesh.colours.emplace_back(0.5 + p.x, 0.5 + p.y, p.z, 1.0);
    }
    const Result<pack::Pack> pack = bake(mesh, quick());
    ASSERT_TRUE(pack);
    EXPECT_LT(pack->levels[pack->default_level].error.colour_rmse, 2.0F);
}

TEST(Levels, UsefulPictureTexelsFollowTheBakeSizeWithinLimits) {
    constexpr std::int64_t a_picture_of_8k = std::int64_t{8192} * 8192;
    EXPECT_EQ(useful_picture_texels(512), a_picture_of_8k);
    EXPECT_EQ(useful_picture_texels(16), std::int64_t{4096} * 4096);
    EXPECT_EQ(useful_picture_texels(4096), 4 * a_picture_of_8k) << "1 GiB is the most";
}

TEST(Levels, MuseumLightIsBrighterAboveThanBelowAndNeverBlack) {
    SourceMesh mesh = test::empty_mesh();
    test::add_sphere(mesh, {0, 0, 0.5}, 0.5, 32);
    BakeOptions options = quick(false);
    options.up = "z";
    const Result<pack::Pack> pack = bake(mesh, options);
    ASSERT_TRUE(pack);
    const pack::PackLevel& level = pack->levels.back();
    const image::Image8& texture = pack->textures[level.texture];
    double above = 0.0;
    double below = 0.0;
    int above_count = 0;
    int below_count = 0;
    for (const pack::PackVertex& vertex : level.vertices) {
        const auto x = static_cast<int>(vertex.uv[0] / 65535.0 * texture.width);
        const auto y = static_cast<int>(vertex.uv[1] / 65535.0 * texture.height);
        const glm::u8vec4 colour =
            texture.at(std::min(x, texture.width - 1), std::min(y, texture.height - 1));
        EXPECT_GT(colour.x, 20);
        if (vertex.position[2] > 50000) {
            above += colour.x;
            ++above_count;
        } else if (vertex.position[2] < 15000) {
            below += colour.x;
            ++below_count;
        }
    }
    ASSERT_GT(above_count, 0);
    ASSERT_GT(below_count, 0);
    EXPECT_GT(above / above_count, 1.5 * below / below_count);
}

} // namespace frustumscreen::bake
