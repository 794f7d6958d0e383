#include "assets_baked/bake/linked_cells.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace frustumscreen {

namespace {

class CellLinks {
public:
    CellLinks(const BlockInput& input, const GridCrossings& grid, int column, int row)
        : input_(input), grid_(grid), column_(column), row_(row) {}

    std::vector<LinkedCell> find() {
        std::vector<LinkedCell> cells;
        for (unsigned corner = 0; corner < 4; ++corner) {
            const std::size_t line = line_at(corner);
            for (std::uint32_t id = grid_.first[line]; id < grid_.first[line + 1]; ++id) {
                if (is_free(id)) {
                    LinkedCell cell = linked_from(corner, id);
                    used_.insert(used_.end(), cell.crossing.begin(), cell.crossing.end());
                    if (is_owned(cell) && complete(cell)) {
                        cells.push_back(cell);
                    }
                }
            }
        }
        return cells;
    }

private:
    [[nodiscard]] std::size_t line_at(unsigned corner) const {
        return grid_.line(column_ + static_cast<int>(corner & 1U), row_ + static_cast<int>(corner >> 1U));
    }
    [[nodiscard]] bool is_free(std::uint32_t id) const {
        return std::find(used_.begin(), used_.end(), id) == used_.end();
    }

    /// The crossing at the neighbouring corner that continues this one best; `axis` 0: along u.
    [[nodiscard]] std::uint32_t linked(std::uint32_t id, unsigned from, unsigned axis) const {
        if (id == no_crossing) {
            return no_crossing;
        }
        const float step = (from >> axis & 1U) != 0 ? -1.0F : 1.0F;
        const auto slope = [&](const Crossing& crossing) {
            return step * (axis == 0 ? crossing.slope_u : crossing.slope_v);
        };
        const Crossing& here = grid_.crossings[id];
        const std::size_t line = line_at(from ^ (1U << axis));
        std::uint32_t best = no_crossing;
        float least = std::numeric_limits<float>::infinity();
        for (std::uint32_t k = grid_.first[line]; k < grid_.first[line + 1]; ++k) {
            const Crossing& there = grid_.crossings[k];
            const float bend = std::abs(slope(here) - slope(there));
            const float miss = std::abs(there.w - here.w - 0.5F * (slope(here) + slope(there)));
            // A smooth surface misses the mean slope's height by less than a few tenths; a crease or a steep one by more.
            const float allowed =
                0.4F + std::min(3.0F, 0.55F * bend) + 0.1F * std::abs(slope(here) + slope(there));
            if (miss < allowed && miss < least && is_free(k)) {
                least = miss;
                best = k;
            }
        }
        return best;
    }

    [[nodiscard]] LinkedCell linked_from(unsigned corner, std::uint32_t id) const {
        LinkedCell cell;
        cell.crossing[corner] = id;
        cell.crossing[corner ^ 1U] = linked(id, corner, 0);
        cell.crossing[corner ^ 2U] = linked(id, corner, 1);
        const std::uint32_t by_u = linked(cell.crossing[corner ^ 1U], corner ^ 1U, 1);
        cell.crossing[corner ^ 3U] =
            by_u != no_crossing ? by_u : linked(cell.crossing[corner ^ 2U], corner ^ 2U, 0);
        return cell;
    }

    [[nodiscard]] bool is_owned(const LinkedCell& cell) const {
        return std::any_of(cell.crossing.begin(), cell.crossing.end(),
                           [this](std::uint32_t id) { return id != no_crossing && grid_.crossings[id].own; });
    }

    /// The height that the corners which are there give to a place of the cell.
    [[nodiscard]] float continued(const LinkedCell& cell, float u, float v) const {
        float sum = 0.0F;
        float count = 0.0F;
        for (unsigned k = 0; k < 4; ++k) {
            if (cell.crossing[k] != no_crossing) {
                const Crossing& corner = grid_.crossings[cell.crossing[k]];
                sum += corner.w + corner.slope_u * (u - static_cast<float>(k & 1U)) +
                       corner.slope_v * (v - static_cast<float>(k >> 1U));
                count += 1.0F;
            }
        }
        return sum / count;
    }

    /// Gives every corner its height; false: the surface is not met at the middle.
    [[nodiscard]] bool complete(LinkedCell& cell) const {
        for (unsigned k = 0; k < 4; ++k) {
            cell.w[k] = cell.crossing[k] != no_crossing
                            ? grid_.crossings[cell.crossing[k]].w
                            : continued(cell, static_cast<float>(k & 1U), static_cast<float>(k >> 1U));
        }
        return cell.whole() || is_met(continued(cell, 0.5F, 0.5F));
    }

    [[nodiscard]] bool is_met(float w) const {
        constexpr double reach = 1.2; // texels to either side
        const double texel_box = 1.0 / input_.texels;
        glm::vec3 outward(0.0F);
        outward[grid_.grid.axis[2]] = static_cast<float>(grid_.grid.sign);
        const glm::vec3 from(
            grid_.box_from_grid(column_ + 0.5, row_ + 0.5, static_cast<double>(w) + reach, texel_box));
        return input_.surface.trace(from, -outward, 0.0F, static_cast<float>(2.0 * reach * texel_box)).hit;
    }

    const BlockInput& input_;
    const GridCrossings& grid_;
    int column_, row_;
    std::vector<std::uint32_t> used_;
};

} // namespace

std::vector<LinkedCell> link_cells(const BlockInput& input, const GridCrossings& grid, int column, int row) {
    return CellLinks(input, grid, column, row).find();
}

} // namespace frustumscreen
