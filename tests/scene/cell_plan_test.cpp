// How a cell is placed by its artifact, and which of its levels a technique means.

#include "app/pack/pack_relief.h"
#include "app/scene/cell_plan.h"
#include "tests/pack/samples.h"

#include <fmt/format.h>
#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

namespace frustumscreen::scene {
namespace {

TEST(CellPlan, SetPoseMovesThePlacedCell) {
    const double metres_per_box = 0.12;
    const glm::dmat4 rest = glm::translate(glm::dmat4(1.0), glm::dvec3(0.1, -0.2, 0.3)) *
                            glm::rotate(glm::dmat4(1.0), 0.7, glm::dvec3(0.6, 0.0, 0.8)) *
                            glm::scale(glm::dmat4(1.0), glm::dvec3(0.25));
    PlacedLevel level;
    level.metres_per_box = metres_per_box_of({.box_from_geometry = rest}, metres_per_box);
    EXPECT_NEAR(level.metres_per_box, 0.25 * metres_per_box, 1e-15);
    const glm::dmat4 moved = glm::translate(glm::dmat4(1.0), glm::dvec3(0.0, 0.05, 0.1)) * rest;
    set_pose(level, {.box_from_geometry = moved, .light = {1.0F, 0.5F, 0.25F}}, metres_per_box);
    EXPECT_EQ(level.light, glm::vec3(1.0F, 0.5F, 0.25F));
    for (const glm::dvec3& point : {glm::dvec3(0.0), glm::dvec3(0.5, -0.25, 1.0)}) {
        const glm::dvec3 expected = metres_per_box * glm::dvec3(moved * glm::dvec4(point, 1.0));
        const glm::dvec3 placed(level.prop_from_box() * glm::dvec4(point, 1.0));
        EXPECT_LE(glm::distance(placed, expected), 1e-15);
    }
}

TEST(CellPlan, ATechniqueIsClampedToWhatTheCellHas) {
    const pack::Pack cell = samples::pack_with_reliefs();
    const pack::PackOutline outline = pack::outline_of(cell);
    const std::uint32_t finest = pack::reliefs_of(cell).value().back().texels;
    const std::size_t last = cell.levels.size() - 1;
    EXPECT_EQ(cell_technique("auto", outline), "auto");
    EXPECT_EQ(cell_technique("finest", outline), "finest");
    EXPECT_EQ(cell_technique("level0", outline), "level0");
    EXPECT_EQ(cell_technique("level31", outline), fmt::format("level{}", last));
    EXPECT_EQ(cell_technique("relief", outline), "relief");
    EXPECT_EQ(cell_technique("relief-gpu", outline), "relief-gpu");
    EXPECT_EQ(cell_technique(fmt::format("relief{}", finest), outline), fmt::format("relief{}", finest));
    EXPECT_EQ(cell_technique("relief65535-gpu", outline), fmt::format("relief{}-gpu", finest));
    EXPECT_EQ(cell_technique("relief96", pack::outline_of(samples::pack())), "auto");
}

TEST(CellPlan, PixelsOfACubeAreAQuarterOfItsSurface) {
    PlacedLevel cube;
    cube.box_size = glm::dvec3(1.0);
    cube.metres_per_box = 0.02;
    PlanView view;
    view.projector = {1280, 800, 2000.0, 2000.0, 640.0, 400.0};
    view.table_from_projector.translation = {0.0, 0.0, 1.01}; // a metre from the cube's middle
    EXPECT_NEAR(pixels_of(cube, view), 1.5 * 40.0 * 40.0, 1e-6);
}

} // namespace
} // namespace frustumscreen::scene
