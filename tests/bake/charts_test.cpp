#include "assets_baked/bake/box_frame.h"
#include "assets_baked/bake/charts.h"
#include "assets_baked/bake/texture_bake.h"
#include "tests/bake/shapes.h"

#include <gtest/gtest.h>

#include <map>

namespace frustumscreen::bake {

namespace {

TriangleMesh sphere_mesh() {
    SourceMesh mesh = test::empty_mesh();
    test::add_sphere(mesh, {0, 0, 0.5}, 0.5, 24);
    return weld(mesh, mesh.positions);
}

} // namespace

TEST(Charts, KeepEveryTriangleWithoutFoldsAndNearlyToScale) {
    const TriangleMesh mesh = sphere_mesh();
    constexpr float texel = 1.0F / 256.0F;
    const ChartedMesh charted = chart(mesh, texel);
    ASSERT_EQ(charted.indices.size(), mesh.indices.size());
    EXPECT_LE(charted.chart_count, 24U);
    for (std::size_t t = 0; t < charted.indices.size(); t += 3) {
        const glm::vec2 a = charted.uv_texels[charted.indices[t]];
        const glm::vec2 b = charted.uv_texels[charted.indices[t + 1]];
        const glm::vec2 c = charted.uv_texels[charted.indices[t + 2]];
        const float map_area = ((b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x)) * texel * texel;
        const glm::vec3 p = charted.positions[charted.indices[t]];
        const float area = glm::length(glm::cross(charted.positions[charted.indices[t + 1]] - p,
                                                  charted.positions[charted.indices[t + 2]] - p));
        EXPECT_GT(map_area, 0.45F * area);
        EXPECT_LT(map_area, 1.01F * area);
        for (const glm::vec2& uv : {a, b, c}) {
            EXPECT_GE(uv.x, static_cast<float>(chart_gutter_texels));
            EXPECT_GE(uv.y, static_cast<float>(chart_gutter_texels));
            EXPECT_LE(uv.x, static_cast<float>(charted.atlas_width - chart_gutter_texels));
            EXPECT_LE(uv.y, static_cast<float>(charted.atlas_height - chart_gutter_texels));
        }
    }
}

/// Six charts, like the sides of a cube, are the fewest for a sphere at these slopes; vertices on their borders are
/// split.
TEST(Charts, FewVerticesAreSplit) {
    const TriangleMesh mesh = sphere_mesh();
    const ChartedMesh charted = chart(mesh, 1.0F / 256.0F);
    const double split =
        static_cast<double>(charted.positions.size()) / static_cast<double>(mesh.positions.size());
    EXPECT_LE(charted.chart_count, 8U);
    EXPECT_LT(split, 1.18);
}

TEST(Charts, NoTexelIsInsideTwoTriangles) {
    const ChartedMesh charted = chart(sphere_mesh(), 1.0F / 128.0F);
    std::map<std::pair<int, int>, int> owners;
    for (std::size_t t = 0; t < charted.indices.size(); t += 3) {
        const glm::vec2 a = charted.uv_texels[charted.indices[t]];
        const glm::vec2 b = charted.uv_texels[charted.indices[t + 1]];
        const glm::vec2 c = charted.uv_texels[charted.indices[t + 2]];
        const auto side = [](glm::vec2 from, glm::vec2 to, glm::vec2 p) {
            return (to.x - from.x) * (p.y - from.y) - (to.y - from.y) * (p.x - from.x);
        };
        const glm::ivec2 low(glm::floor(glm::min(a, glm::min(b, c))));
        const glm::ivec2 high(glm::ceil(glm::max(a, glm::max(b, c))));
        for (int y = low.y; y <= high.y; ++y) {
            for (int x = low.x; x <= high.x; ++x) {
                const glm::vec2 p(static_cast<float>(x) + 0.5F, static_cast<float>(y) + 0.5F);
                if (side(a, b, p) > 1e-3F && side(b, c, p) > 1e-3F && side(c, a, p) > 1e-3F) {
                    EXPECT_EQ(++owners[std::make_pair(x, y)], 1);
                }
            }
        }
    }
    EXPECT_GT(owners.size(), 20000U);
}

/// A triangle of a coarser mesh that rounding presses flat has no chart; one of the finer mesh has it for its nearest neighbour.
TEST(Charts, ATriangleWithoutAreaIsOmitted) {
    const TriangleMesh square{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {0, 1, 2, 0, 2, 3}};
    TriangleMesh coarse = square;
    coarse.positions.insert(coarse.positions.end(), {{0, 0, 1}, {0.05F, 0, 1}, {0.1F, 0, 1}});
    coarse.indices.insert(coarse.indices.end(), {4, 5, 6});
    TriangleMesh fine = square;
    fine.positions.insert(fine.positions.end(),
                          {{0.02F, 0.02F, 1}, {0.06F, 0.02F, 1}, {0.04F, 0.02F, 1.04F}});
    fine.indices.insert(fine.indices.end(), {4, 5, 6});
    SharedCharts charts(1.0F / 128.0F, 4096);
    charts.add(coarse, 0.0F);
    charts.add(fine, 0.1F);
    const std::vector<ChartedMesh> meshes = charts.lay_out();
    EXPECT_EQ(meshes[0].indices.size(), 6U);
    EXPECT_EQ(meshes[1].indices.size(), 9U);
}

} // namespace frustumscreen::bake
