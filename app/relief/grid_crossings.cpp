#include "app/relief/grid_crossings.h"

#include <algorithm>

namespace frustumscreen::relief {

glm::dvec3 grid_from_box(const ReliefGrid& grid, const glm::dvec3& point, double texel_box) {
    glm::dvec3 at;
    for (int k = 0; k < 3; ++k) {
        const int axis = grid.axis[static_cast<std::size_t>(k)];
        at[k] = (k == 2 ? grid.sign : 1.0) * (point[axis] - grid.origin_box[axis]) / texel_box;
    }
    return at;
}

std::span<const SheetEnd> GridCrossings::ends_in(int column, int row) const {
    const std::pair<int, int> cell(row, column);
    const auto first = std::lower_bound(ends.begin(), ends.end(), cell,
                                        [](const SheetEnd& end, const auto& of) { return end.cell() < of; });
    const auto last = std::upper_bound(first, ends.end(), cell,
                                       [](const auto& of, const SheetEnd& end) { return of < end.cell(); });
    return {first, last};
}

} // namespace frustumscreen::relief
