#include "app/world/cell.h"

#include <cassert>

namespace frustumscreen::world {

glm::dmat4 LocalPose::matrix() const {
    glm::dmat4 matrix = glm::mat4_cast(rotation);
    for (int axis = 0; axis < 3; ++axis) {
        matrix[axis] *= scale[axis];
    }
    matrix[3] = glm::dvec4(translation, 1.0);
    return matrix;
}

void pose_cells(std::span<const Cell> cells, std::span<const LocalPose> local, std::vector<CellPose>& poses) {
    assert(cells.size() == local.size());
    poses.resize(cells.size());
    // First box_from_cell, which the children need; parents come before their children.
    for (std::size_t k = 0; k < cells.size(); ++k) {
        const glm::dmat4 parent_from_cell = cells[k].parent_from_base * local[k].matrix();
        poses[k].box_from_geometry =
            cells[k].parent ? poses[*cells[k].parent].box_from_geometry * parent_from_cell : parent_from_cell;
    }
    for (std::size_t k = 0; k < cells.size(); ++k) {
        if (cells[k].has_geometry) {
            poses[k].box_from_geometry *= cells[k].cell_from_geometry;
        }
    }
}

std::vector<CellPose> poses_at_rest(std::span<const Cell> cells) {
    std::vector<LocalPose> local;
    for (const Cell& cell : cells) {
        local.push_back(cell.rest);
    }
    std::vector<CellPose> poses;
    pose_cells(cells, local, poses);
    return poses;
}

} // namespace frustumscreen::world
