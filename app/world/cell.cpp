#include "app/world/cell.h"

#include <algorithm>
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

void pose_cells(std::span<const Cell> cells, std::span<const glm::dmat4> base_from_cell,
                std::vector<CellPose>& poses) {
    assert(cells.size() == base_from_cell.size());
    poses.resize(cells.size());
    // First box_from_cell, which the children need; parents come before their children.
    for (std::size_t k = 0; k < cells.size(); ++k) {
        const glm::dmat4 parent_from_cell = cells[k].parent_from_base * base_from_cell[k];
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
    std::vector<glm::dmat4> base_from_cell;
    base_from_cell.reserve(cells.size());
    for (const Cell& cell : cells) {
        base_from_cell.push_back(cell.rest.matrix());
    }
    std::vector<CellPose> poses;
    pose_cells(cells, base_from_cell, poses);
    return poses;
}

std::vector<CellExtent> extents_of(std::span<const Cell> cells) {
    std::vector<CellExtent> extents(cells.size());
    for (std::size_t k = 0; k < cells.size(); ++k) {
        if (!cells[k].has_geometry) {
            continue;
        }
        // Up the tree: the corners of the geometry's box in the frame of each cell above.
        glm::dmat4 above_from_geometry = cells[k].cell_from_geometry;
        for (std::optional<std::size_t> above = k; above; above = cells[*above].parent) {
            CellExtent& extent = extents[*above];
            extent.size = std::max(extent.size, glm::length(glm::dvec3(above_from_geometry[0])));
            for (int corner = 0; corner < 8; ++corner) {
                const glm::dvec4 point((corner & 1) != 0 ? 0.5 : -0.5, (corner & 2) != 0 ? 0.5 : -0.5,
                                       (corner & 4) != 0 ? 1.0 : 0.0, 1.0);
                extent.radius = std::max(extent.radius, glm::length(glm::dvec3(above_from_geometry * point)));
            }
            above_from_geometry =
                cells[*above].parent_from_base * cells[*above].rest.matrix() * above_from_geometry;
        }
    }
    return extents;
}

} // namespace frustumscreen::world
