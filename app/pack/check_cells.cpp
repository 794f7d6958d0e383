#include "app/pack/check_world.h"
#include "app/pack/pack_text.h"
#include "app/pack/relief_texel.h"
#include "firmware_host/base/printable.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string_view>

namespace frustumscreen::pack {

namespace {

constexpr double rotation_tolerance = 1e-3;
constexpr double box_tolerance = 1e-3; ///< as hotspots
constexpr double max_element = 1e9;    ///< of a matrix
constexpr double min_independence =
    1e-9; ///< of a matrix's axes: 1 if they are perpendicular, 0 if they lie in a plane

bool is_bounded(const glm::dvec3& v) {
    return std::abs(v.x) <= max_element && std::abs(v.y) <= max_element && std::abs(v.z) <= max_element;
} // false for NaN

/// An affine map that can be inverted: bounded, and its three axes have a length and do not lie in one plane.
bool is_invertible(const glm::dmat4& m) {
    const glm::dmat3 linear(m);
    const double lengths = glm::length(linear[0]) * glm::length(linear[1]) * glm::length(linear[2]);
    const bool affine = m[0][3] == 0.0 && m[1][3] == 0.0 && m[2][3] == 0.0 && m[3][3] == 1.0;
    return affine && is_bounded(linear[0]) && is_bounded(linear[1]) && is_bounded(linear[2]) &&
           is_bounded(glm::dvec3(m[3])) && lengths > 0.0 &&
           std::abs(glm::determinant(linear)) >= min_independence * lengths;
}

bool is_unit(const glm::dquat& q) {
    return std::abs(std::hypot(std::hypot(q.w, q.x), std::hypot(q.y, q.z)) - 1.0) <= rotation_tolerance;
}

Result<void> check_name(const std::string& name, std::size_t number, std::set<std::string_view>& names) {
    if (const std::optional<std::string> fault = fault_of_text(name, TextShape::Line)) {
        return bad_input("cell.name", "the name of cell {} {} (it is '{}')", number, *fault,
                         printable(name, 40));
    }
    if (name.empty() || !names.insert(name).second) {
        return bad_input("cell.name_twice",
                         "cell {} is called '{}'; each cell needs a name of its own: name it so in the model",
                         number, printable(name, 40));
    }
    return {};
}

Result<void> check_box(const std::string& place, const PackCell& cell, const glm::dvec3& box_size) {
    const glm::dvec3 size = cell.high - cell.low;
    if (!is_bounded(cell.low) || !is_bounded(cell.high) || !(std::min({size.x, size.y, size.z}) >= 0.0) ||
        !(std::max({size.x, size.y, size.z}) > 0.0)) {
        return bad_input(
            "cell.no_size",
            "{} is {} x {} x {} of the artifact's longest edge; a cell needs a size, or no triangles", place,
            size.x, size.y, size.z);
    }
    const glm::dvec3 below = box_low(box_size) - cell.low;
    const glm::dvec3 above = cell.high - box_low(box_size) - box_size;
    const glm::dvec3 beyond = glm::max(below, above);
    if (!(std::max({beyond.x, beyond.y, beyond.z}) <= box_tolerance)) {
        return bad_input(
            "cell.outside_box",
            "{} reaches {} of the longest edge out of the artifact's box; it holds all cells at rest", place,
            std::max({beyond.x, beyond.y, beyond.z}));
    }
    return {};
}

Result<void> check_geometry(const std::string& place, const PackCell& cell, const glm::dvec3& box_size) {
    if (cell.cell.has_geometry) {
        return check_box(place, cell, box_size);
    }
    if (cell.triangles != 0 || cell.low != glm::dvec3(0.0) || cell.high != glm::dvec3(0.0) ||
        cell.cell.cell_from_geometry != glm::dmat4(1.0)) {
        return bad_input("cell.no_geometry",
                         "{} has no geometry of its own, and {} triangles or a box; allowed are none", place,
                         cell.triangles);
    }
    return {};
}

Result<void> check_cell(const std::string& place, const PackCell& packed, std::size_t number,
                        const glm::dvec3& box_size) {
    const world::Cell& cell = packed.cell;
    if (cell.parent && *cell.parent >= number) {
        return bad_input(
            "cell.parent",
            "{} hangs from cell {}; allowed are the cells before it, so that no cell hangs from itself",
            place, *cell.parent);
    }
    if (!is_invertible(cell.parent_from_base) || !is_invertible(cell.cell_from_geometry) ||
        !is_unit(cell.rest.rotation) || !is_invertible(cell.rest.matrix())) {
        return bad_input(
            "cell.pose",
            "{} has a pose that is not finite, or that presses it flat; give its node in the model "
            "a scale other than 0",
            place);
    }
    return check_geometry(place, packed, box_size);
}

} // namespace

Result<void> check_cells(const std::vector<PackCell>& cells, const PackDescription& pack) {
    if (cells.size() > world::max_cells) {
        return bad_input("cell.count", "the pack has {} cells, allowed are {}; join parts that do not move",
                         cells.size(), world::max_cells);
    }
    std::set<std::string_view> names;
    std::vector<world::Cell> tree;
    for (std::size_t k = 0; k < cells.size(); ++k) {
        TRY_VOID(check_name(cells[k].cell.name, k, names));
        const std::string place = fmt::format("cell '{}'", printable(cells[k].cell.name, 40));
        TRY_VOID(check_cell(place, cells[k], k, pack.box_size));
        tree.push_back(cells[k].cell);
    }
    const std::vector<world::CellPose> poses = world::poses_at_rest(tree);
    for (std::size_t k = 0; k < cells.size(); ++k) {
        if (!is_invertible(poses[k].box_from_geometry)) {
            return bad_input(
                "cell.chain",
                "the poses from the artifact down to cell '{}' combine to one that is not finite",
                printable(cells[k].cell.name, 40));
        }
    }
    return {};
}

} // namespace frustumscreen::pack
