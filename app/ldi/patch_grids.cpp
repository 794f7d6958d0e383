#include "app/ldi/patch_grids.h"

#include <algorithm>
#include <cmath>

namespace frustumscreen::ldi {

namespace {

int lines_for(double extent_texels) {
    const int cells = static_cast<int>(std::ceil(extent_texels)) + 1; // half a cell of rim on either side
    return (cells + relief::block_cells - 1) / relief::block_cells * relief::block_cells + 1;
}

/// The axes of u, v and w, as in the bake.
std::array<int, 3> axes_of(std::size_t direction) {
    switch (direction / 2) {
    case 0:
        return {1, 2, 0};
    case 1:
        return {0, 2, 1};
    default:
        return {0, 1, 2};
    }
}

} // namespace

double PatchGrids::allowed_texel_m(const glm::dvec3& low, const glm::dvec3& high, double texel_m) {
    const glm::dvec3 size = high - low;
    return std::max(texel_m, std::max({size.x, size.y, size.z}) / (max_lines - 2 * relief::block_cells));
}

PatchGrids::PatchGrids(const PatchView& view, const glm::dvec3& low, const glm::dvec3& high, double texel)
    : texel_m(texel) {
    const glm::dvec3 size = glm::max(high - low, glm::dvec3(texel));
    box_m = std::max({size.x, size.y, size.z});
    box_size = size / box_m;
    const glm::dvec3 bottom(0.5 * (low.x + high.x), 0.5 * (low.y + high.y), low.z);
    const glm::dmat3 window_from_patch = glm::inverse(view.patch_from_window());
    window_from_box = glm::dmat4(box_m * window_from_patch);
    window_from_box[3] = glm::dvec4(window_from_patch * bottom, 1.0);
    const auto texel_box = static_cast<double>(static_cast<float>(texel / box_m)); // as a relief stores it
    texel_m = texel_box * box_m;
    const glm::dvec3 box_low(-0.5 * box_size.x, -0.5 * box_size.y, 0.0);
    for (std::size_t k = 0; k < grid_directions; ++k) {
        PatchGrid& of = directions[k];
        of.grid.axis = axes_of(k);
        of.grid.sign = k % 2 == 0 ? 1.0 : -1.0;
        const int across = of.grid.axis[2];
        of.grid.origin_box = box_low - 0.5 * texel_box;
        of.grid.origin_box[across] = box_low[across] + (k % 2 == 0 ? 0.0 : box_size[across]);
        of.columns = lines_for(size[of.grid.axis[0]] / texel_m);
        of.rows = lines_for(size[of.grid.axis[1]] / texel_m);
        of.window_from_grid = window_from_box * relief::box_from_grid(of.grid, texel_box);
        of.grid_from_window = glm::inverse(of.window_from_grid);
    }
}

} // namespace frustumscreen::ldi
