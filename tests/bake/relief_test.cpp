#include "assets_baked/bake/bake.h"
#include "assets_baked/bake/relief.h"
#include "assets_baked/bake/visibility.h"
#include "tests/bake/shapes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace frustumscreen {

namespace {

const std::vector<ReliefDirection> frustum_directions{ReliefDirection::PlusX, ReliefDirection::MinusX,
                                                      ReliefDirection::PlusY, ReliefDirection::MinusY,
                                                      ReliefDirection::PlusZ};

std::optional<BakedRelief> relief_of(const SourceMesh& mesh, int size) {
    const SourceScene source(mesh, mesh.positions);
    const TriangleMesh visible = visible_sides(weld(mesh, mesh.positions), source, ViewingZone{});
    return bake_relief(source, visible, glm::dvec3(1.0), frustum_directions, size);
}

} // namespace

TEST(Relief, EverySampleOfASphereLiesOnItAndFacesItsDirection) {
    SourceMesh mesh = test::empty_mesh();
    test::add_sphere(mesh, {0, 0, 0.5}, 0.5, 96);
    const auto relief = relief_of(mesh, 96);
    ASSERT_TRUE(relief);
    ASSERT_GT(relief->grid.positions.size(), 5000U);
    for (const glm::vec3& p : relief->grid.positions) {
        EXPECT_NEAR(glm::distance(p, glm::vec3(0, 0, 0.5)), 0.5, 5e-4);
    }
    for (std::size_t t = 0; t < relief->grid.indices.size(); t += 3) {
        const glm::vec3& a = relief->grid.positions[relief->grid.indices[t]];
        const glm::vec3 normal = glm::cross(relief->grid.positions[relief->grid.indices[t + 1]] - a,
                                            relief->grid.positions[relief->grid.indices[t + 2]] - a);
        EXPECT_GT(glm::dot(normal, a - glm::vec3(0, 0, 0.5)), 0.0F);
    }
}

TEST(Relief, ALayerBehindAnotherIsKept) {
    // A small box on a stalk-less shelf: two boxes one behind the other along X, both seen obliquely from
    // above.
    SourceMesh mesh = test::empty_mesh();
    test::add_box(mesh, {-0.5, -0.2, 0.0}, {-0.3, 0.2, 0.5});
    test::add_box(mesh, {0.3, -0.2, 0.0}, {0.5, 0.2, 0.5});
    const auto relief = relief_of(mesh, 64);
    ASSERT_TRUE(relief);
    bool near_layer = false;
    bool far_layer = false;
    for (const ReliefChart& chart : relief->atlas.charts) {
        if (chart.direction != ReliefDirection::PlusX) {
            continue;
        }
        for (int y = chart.y; y < chart.y + chart.height; ++y) {
            for (int x = chart.x; x < chart.x + chart.width; ++x) {
                const std::uint16_t code = relief->atlas.relief.at(x, y);
                if (code == 65535) {
                    continue;
                }
                const double along = code / 65534.0 - 0.5;
                near_layer = near_layer || std::abs(along - 0.5) < 1e-3;
                far_layer = far_layer || std::abs(along + 0.3) < 1e-3;
            }
        }
    }
    EXPECT_TRUE(near_layer);
    EXPECT_TRUE(far_layer);
}

TEST(Relief, ItsLevelsAreOnTheFrontWhereASourceCannotBeSimplified) {
    // A soup: a sphere of thirty thousand triangles that share no vertex, each overlapping its neighbours.
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
    options.relief = false; // none to be cast
    options.size = 64;
    options.unlit = true;
    options.measuring = 0.1;
    options.up = "z";
    const Result<Pack> pack = bake(soup, options);
    ASSERT_TRUE(pack);
    const PackLevel& cheapest = pack->levels.front();
    EXPECT_EQ(cheapest.technique, LevelTechnique::Relief);
    EXPECT_LT(cheapest.indices.size(), soup.triangles.size() / 2);
    EXPECT_LT(cheapest.error.mean_box, 3e-3F);
}

} // namespace frustumscreen
