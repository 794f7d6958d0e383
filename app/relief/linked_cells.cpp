#include "app/relief/linked_cells.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace frustumscreen::relief {

namespace {

class CellLinks {
public:
    CellLinks(const GridCrossings& grid, const CellLines& lines, int column, int row,
              std::vector<std::uint32_t>& used, CutMemory& cut)
        : grid_(grid), lines_(lines), column_(column), row_(row), used_(used), cut_(cut) {}

    void find(std::vector<LinkedCell>& cells) {
        cells.clear();
        used_.clear();
        if (!may_own()) {
            return;
        }
        for (unsigned corner = 0; corner < 4; ++corner) {
            const std::size_t line = line_at(corner);
            for (std::uint32_t id = grid_.first[line]; id < grid_.first[line + 1]; ++id) {
                if (is_free(id)) {
                    LinkedCell cell = linked_from(corner, id);
                    used_.insert(used_.end(), cell.crossing.begin(), cell.crossing.end());
                    cell.own = is_owned(cell);
                    complete(cell);
                    cells.push_back(cell);
                }
            }
        }
        for (const SheetEnd& end : grid_.ends_in(column_, row_)) {
            const bool is_known = std::any_of(cells.begin(), cells.end(), [&end](const LinkedCell& cell) {
                return std::abs(height_over({cell.w, {}}, end)) < half_texel_away(end);
            });
            if (!is_known) {
                cells.push_back(cell_at(end));
            }
        }
        cells.erase(std::remove_if(cells.begin(), cells.end(),
                                   [](const LinkedCell& cell) { return !cell.own || cell.cover == 0; }),
                    cells.end());
    }

private:
    /// False if no surface over the cell can be kept.
    [[nodiscard]] bool may_own() const {
        for (unsigned corner = 0; corner < 4; ++corner) {
            const std::size_t line = line_at(corner);
            for (std::uint32_t id = grid_.first[line]; id < grid_.first[line + 1]; ++id) {
                if (grid_.crossings[id].own) {
                    return true;
                }
            }
        }
        return !grid_.ends_in(column_, row_).empty();
    }
    /// Distance along the line for half a texel across the surface.
    [[nodiscard]] static float half_texel_away(const LineCrossing& crossing) {
        return 0.5F *
               std::sqrt(1.0F + crossing.slope_u * crossing.slope_u + crossing.slope_v * crossing.slope_v);
    }
    [[nodiscard]] std::size_t line_at(unsigned corner) const {
        return grid_.line(column_ + static_cast<int>(corner & 1U), row_ + static_cast<int>(corner >> 1U));
    }
    [[nodiscard]] bool is_free(std::uint32_t id) const {
        return std::find(used_.begin(), used_.end(), id) == used_.end();
    }

    /// The crossing at the neighbouring corner that best continues this one; `axis` 0: along u.
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
            // A smooth surface misses the mean slope's height by less than a few tenths of a texel; a crease
            // or a steep surface by more.
            const float allowed =
                0.4F + std::min(3.0F, 0.55F * bend) + 0.1F * std::abs(slope(here) + slope(there));
            if (miss < allowed && miss < least && !is_crease(slope(here), slope(there)) && is_free(k)) {
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

    /// Height at a position of the cell, extrapolated from the known corners.
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

    /// A surface that no corner's line crosses.
    [[nodiscard]] LinkedCell cell_at(const SheetEnd& end) {
        CornerHeights corners;
        for (unsigned k = 0; k < 4; ++k) {
            corners.w[k] = end.w +
                           end.slope_u * (static_cast<float>(column_) + static_cast<float>(k & 1U) - end.u) +
                           end.slope_v * (static_cast<float>(row_) + static_cast<float>(k >> 1U) - end.v);
        }
        LinkedCell cell;
        cell.cover = cut_cell(grid_, lines_, column_, row_, corners, cut_);
        cell.w = corners.w;
        cell.colour = end.colour;
        cell.own = true;
        return cell;
    }

    /// Sets the height of every corner and, if the cell is kept (`own`), cuts it where it lacks corners.
    void complete(LinkedCell& cell) {
        CornerHeights corners;
        for (unsigned k = 0; k < 4; ++k) {
            corners.known[k] = cell.crossing[k] != no_crossing;
            corners.w[k] = corners.known[k]
                               ? grid_.crossings[cell.crossing[k]].w
                               : continued(cell, static_cast<float>(k & 1U), static_cast<float>(k >> 1U));
        }
        cell.cover = cell.whole() || !cell.own ? ~std::uint64_t{0}
                                               : cut_cell(grid_, lines_, column_, row_, corners, cut_);
        cell.w = corners.w;
    }

    const GridCrossings& grid_;
    const CellLines& lines_;
    int column_, row_;
    std::vector<std::uint32_t>& used_;
    CutMemory& cut_;
};

} // namespace

std::span<const LinkedCell> CellLinker::link(int column, int row) {
    CellLinks(grid_, lines_, column, row, used_, cut_).find(cells_);
    return cells_;
}

} // namespace frustumscreen::relief
