/// A world: a tree of cells, each with a pose of its own. A plain artifact is a world without cells.
///
/// Frames   box: of the artifact's pack (pack.h); the tree's roots lie in it. Cell: the frame in which a cell moves,
///          glTF's node. Geometry: the box of the cell's own geometry, which is baked like an artifact's.
///          box_from_cell = box_from_parent * parent_from_base * base_from_cell.
/// Units    box units; a rotation is a unit quaternion.
/// Threads  values; any. `pose_cells` allocates nothing into a list with the capacity.
/// Source   Kim 2008, "Mixed object node"; Khronos, glTF 2.0, 3.5.3 (a node's transform is T * R * S).
#pragma once

#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace frustumscreen::world {

inline constexpr std::size_t max_cells = 256;

/// base_from_cell, in parts that move by themselves: T * R * S.
struct LocalPose {
    glm::dvec3 translation{0.0};
    glm::dquat rotation{1.0, 0.0, 0.0, 0.0};
    glm::dvec3 scale{1.0};

    [[nodiscard]] glm::dmat4 matrix() const;
    [[nodiscard]] bool operator==(const LocalPose&) const = default;
};

struct Cell {
    std::string name;
    std::optional<std::size_t> parent;  ///< index into the world's cells, before this one; none: a root
    glm::dmat4 parent_from_base{1.0};   ///< of a root: box_from_base
    LocalPose rest;                     ///< base_from_cell while nothing moves
    glm::dmat4 cell_from_geometry{1.0}; ///< used if `has_geometry`
    bool has_geometry = false;

    [[nodiscard]] bool operator==(const Cell&) const = default;
};

/// Where a cell's geometry is, and its light.
struct CellPose {
    glm::dmat4 box_from_geometry{1.0};
    glm::vec3 light{1.0F}; ///< factor of its colours, linear light, red, green and blue

    [[nodiscard]] bool operator==(const CellPose&) const = default;
};

/// One pose for each cell, from base_from_cell of each; `light` stays. A cell without geometry gets its own frame's.
void pose_cells(std::span<const Cell> cells, std::span<const glm::dmat4> base_from_cell,
                std::vector<CellPose>& poses);
/// The poses while nothing moves.
[[nodiscard]] std::vector<CellPose> poses_at_rest(std::span<const Cell> cells);

/// How large a cell's geometry and all below it is at rest, in the cell's frame; 0: there is none.
struct CellExtent {
    double size = 0.0;   ///< the longest edge of the largest geometry's box
    double radius = 0.0; ///< the farthest corner of a box from the cell's origin
};
[[nodiscard]] std::vector<CellExtent> extents_of(std::span<const Cell> cells);

} // namespace frustumscreen::world
