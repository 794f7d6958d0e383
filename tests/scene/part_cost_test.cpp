// The decision for or against cells, with costs that are sums on paper.
#include "app/scene/part_cost.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace frustumscreen;
using namespace frustumscreen::scene;

namespace {

constexpr PartCosts costs{.picture = 2.0, .per_triangle = 1e-4, .per_block = 2e-4, .per_part = 0.25};

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
    const PartWay way = quickest_way(part(), 100.0, 0.1, costs).value();
    EXPECT_EQ(way.way.level, 1U);
    EXPECT_TRUE(way.way.enough);
    EXPECT_FALSE(way.way.relief);
    EXPECT_DOUBLE_EQ(way.cost, 2.0);
    const PartWay coarse = quickest_way(part(), 100.0, 10.0, costs).value();
    EXPECT_EQ(coarse.way.level, 0U);
    EXPECT_DOUBLE_EQ(coarse.cost, 0.1);
}

TEST(PartCost, WithoutAGoodWayTheFinestLevelIs) {
    const PartWay way = quickest_way(part(), 100.0, 1e-6, costs).value();
    EXPECT_EQ(way.way.level, 2U);
    EXPECT_FALSE(way.way.enough);
    EXPECT_DOUBLE_EQ(way.cost, 5.0);
    EXPECT_EQ(quickest_way(part(), std::nan(""), 0.1, costs).value().way.level, 2U);
}

TEST(PartCost, AFrameIsThePictureAndEachPart) {
    const std::vector<PartWay> parts{{{}, 1.0}, {{}, 0.5}, {{}, 0.25}};
    EXPECT_DOUBLE_EQ(frame_cost(std::span(parts).first(1), costs), 3.0);
    EXPECT_DOUBLE_EQ(frame_cost(parts, costs), 2.0 + 1.75 + 2 * 0.25);
    EXPECT_DOUBLE_EQ(frame_cost({}, costs), 2.0);
}

TEST(PartCost, CellsPayFromATenthOn) {
    EXPECT_TRUE(cells_pay(10.0, 8.99));
    EXPECT_FALSE(cells_pay(10.0, 9.01));
    EXPECT_FALSE(cells_pay(10.0, std::nan("")));
    EXPECT_FALSE(cells_pay(std::nan(""), 1.0));
}

} // namespace
