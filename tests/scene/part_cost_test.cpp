// The decision for or against cells, with costs that are sums on paper.
#include "app/scene/part_cost.h"

#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <span>
#include <vector>

using namespace frustumscreen;
using namespace frustumscreen::scene;

namespace {

constexpr PartCosts costs{
    .mesh_picture = 3.0, .relief_picture = 2.0, .per_triangle = 1e-4, .per_block = 2e-4, .per_part = 0.25};

pack::LevelOutline level(std::uint64_t triangles, float mean_box) {
    pack::LevelOutline made;
    made.technique = pack::LevelTechnique::Mesh;
    made.error.mean_box = mean_box;
    made.triangles = triangles;
    return made;
}

/// A part of 100 mm that may err by 0.1 mm: levels of 0.2, 0.05 and 0.01 mm.
pack::PackOutline part() {
    pack::PackOutline outline;
    outline.description.box_size = glm::dvec3(1.0);
    outline.levels = {level(1000, 2e-3F), level(20'000, 3e-4F), level(50'000, 1e-4F)};
    return outline;
}

TEST(PartCost, TheQuickestWayThatIsGoodEnoughIsTaken) {
    const PartWay way = good_ways(part(), 100.0, 0.1, costs).value().mesh;
    EXPECT_EQ(way.way.level, 1U);
    EXPECT_TRUE(way.way.enough);
    EXPECT_FALSE(way.way.relief);
    EXPECT_DOUBLE_EQ(way.cost, 2.0);
    const PartWay coarse = good_ways(part(), 100.0, 10.0, costs).value().mesh;
    EXPECT_EQ(coarse.way.level, 0U);
    EXPECT_DOUBLE_EQ(coarse.cost, 0.1);
}

TEST(PartCost, TakesTheFinestLevelWhenNoneSuffices) {
    const PartWay way = good_ways(part(), 100.0, 1e-6, costs).value().mesh;
    EXPECT_EQ(way.way.level, 2U);
    EXPECT_FALSE(way.way.enough);
    EXPECT_DOUBLE_EQ(way.cost, 5.0);
    EXPECT_EQ(good_ways(part(), std::nan(""), 0.1, costs).value().mesh.way.level, 2U);
}

PartWays ways(double mesh, std::optional<double> relief) {
    PartWays made;
    made.mesh = {{.enough = true}, mesh};
    if (relief) {
        made.relief = PartWay{{.enough = true, .relief = true}, *relief};
    }
    return made;
}

TEST(PartCost, AFrameOfOneKindPaysForOnePicture) {
    const std::vector<PartWays> parts{ways(1.0, 1.5), ways(2.0, 0.5), ways(0.25, 0.75)};
    // Meshes: 3 + 3.25 + 0.5; reliefs: 2 + 2.75 + 0.5; both: 5 + 1.75 + 0.5.
    const PartFrame frame = quickest_frame(parts, costs);
    EXPECT_DOUBLE_EQ(frame.cost, 5.25);
    for (const PartWay& way : frame.ways) {
        EXPECT_TRUE(way.way.relief);
    }
    EXPECT_DOUBLE_EQ(quickest_frame(std::span(parts).first(1), costs).cost, 3.5);
    EXPECT_DOUBLE_EQ(quickest_frame({}, costs).cost, 2.0);
}

TEST(PartCost, APartWithoutAReliefDecidesForMeshesUnlessBothPicturesPay) {
    const PartFrame meshes = quickest_frame(std::vector{ways(1.0, std::nullopt), ways(2.0, 0.5)}, costs);
    EXPECT_DOUBLE_EQ(meshes.cost, 3.0 + 3.0 + 0.25);
    EXPECT_FALSE(meshes.ways[1].way.relief);
    const PartFrame both = quickest_frame(std::vector{ways(1.0, std::nullopt), ways(9.0, 0.5)}, costs);
    EXPECT_DOUBLE_EQ(both.cost, 5.0 + 1.5 + 0.25);
    EXPECT_FALSE(both.ways[0].way.relief);
    EXPECT_TRUE(both.ways[1].way.relief);
}

TEST(PartCost, CellsPayFromATenthSaved) {
    EXPECT_TRUE(cells_pay(10.0, 8.99));
    EXPECT_FALSE(cells_pay(10.0, 9.01));
    EXPECT_FALSE(cells_pay(10.0, std::nan("")));
    EXPECT_FALSE(cells_pay(std::nan(""), 1.0));
}

} // namespace
