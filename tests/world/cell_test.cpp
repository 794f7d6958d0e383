// The tree's poses against products of matrices written out.

#include "app/world/cell.h"
#include "tests/world/some_worlds.h"

#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

namespace frustumscreen::world {
namespace {

TEST(Cells, RestPosesFollowTheTransformChain) {
    const std::vector<Cell> cells = chest();
    const std::vector<CellPose> poses = poses_at_rest(cells);
    const glm::dmat4 one(1.0);
    const glm::dmat4 lid = glm::translate(one, {0.0, 0.5, 0.4}) * glm::translate(one, {0.1, 0.0, 0.2}) *
                           glm::rotate(one, 0.3, {0.0, 0.0, 1.0}) * glm::scale(one, {1.0, 2.0, 0.5});
    EXPECT_LT(difference(poses[0].box_from_geometry, one), 1e-15);
    EXPECT_LT(difference(poses[1].box_from_geometry, lid * glm::scale(one, glm::dvec3(0.8))), 1e-15);
    EXPECT_LT(difference(poses[2].box_from_geometry, lid), 1e-15); // without the lid's own geometry
    EXPECT_EQ(poses[2].light, glm::vec3(1.0F));
}

TEST(Cells, ExtentsIncludeAllDescendants) {
    std::vector<Cell> cells(3); // a group; a cell 2 long and 10 away; one without anything
    cells[1].parent = 0;
    cells[1].parent_from_base[3] = {10.0, 0.0, 0.0, 1.0};
    cells[1].has_geometry = true;
    cells[1].cell_from_geometry = glm::scale(glm::dmat4(1.0), glm::dvec3(2.0));
    const std::vector<CellExtent> extents = extents_of(cells);
    EXPECT_DOUBLE_EQ(extents[0].size, 2.0);
    EXPECT_DOUBLE_EQ(extents[0].radius, std::sqrt(11.0 * 11.0 + 1.0 + 4.0));
    EXPECT_DOUBLE_EQ(extents[1].radius, std::sqrt(1.0 + 1.0 + 4.0));
    EXPECT_EQ(extents[2].size, 0.0);
}

} // namespace
} // namespace frustumscreen::world
