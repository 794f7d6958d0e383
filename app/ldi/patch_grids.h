/// The grids of a patch's relief: one for each direction, and the box that holds them.
///
/// Frames   window, patch (patch_view.h); box and grid as in app/relief/block_relief.h. The box's axes are the patch's.
/// Threads  values; any.
#pragma once

#include "app/ldi/patch_view.h"
#include "app/relief/block_relief.h"

#include <glm/glm.hpp>

#include <array>

namespace frustumscreen::ldi {

inline constexpr int max_lines = 16384; ///< of a grid, along either side

struct PatchGrid {
    relief::ReliefGrid grid;
    int columns = 0, rows = 0;      ///< lines: whole blocks and one more
    glm::dmat4 grid_from_window{1}; ///< texels
    glm::dmat4 window_from_grid{1};

    [[nodiscard]] int bands() const { return (rows - 1) / relief::block_cells; }
};

struct PatchGrids {
    double texel_m = 0.0;
    double box_m = 1.0; ///< the box's unit
    glm::dvec3 box_size{1.0};
    glm::dmat4 window_from_box{1.0}; ///< affine
    std::array<PatchGrid, grid_directions> directions;

    /// Around `low` to `high`, patch frame.
    PatchGrids(const PatchView& view, const glm::dvec3& low, const glm::dvec3& high, double texel_m);
    /// The least texel, from `texel_m` up, with which no grid has more than `max_lines`.
    [[nodiscard]] static double allowed_texel_m(const glm::dvec3& low, const glm::dvec3& high,
                                                double texel_m);
};

} // namespace frustumscreen::ldi
