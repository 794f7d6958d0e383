// The cells of a band: finds the cells that the surface does not fill, crosses lines through them, and makes the blocks.
#include "app/ldi/grid_band.h"
#include "app/ldi/surface_colour.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace frustumscreen::ldi {

namespace {

constexpr std::uint32_t no_slot = std::numeric_limits<std::uint32_t>::max();
constexpr int parts = relief::CellCrossings::parts;
/// A larger distance from the relief is a gap between two surfaces; finer texels would not close it.
constexpr double max_compared = 4.0; // texels

} // namespace

/// Notes the cells that the linker asks for, and returns no crossings.
class GridBand::CellRecorder : public relief::CellLines {
public:
    explicit CellRecorder(GridBand& band) : band_(band) {}
    void cross(int column, int row, const glm::dvec2& range, relief::CellCrossings& found) const override {
        band_.take_slot(column, row, glm::vec2(range));
        found.crossings.clear();
        found.first.fill(0);
    }

private:
    GridBand& band_;
};

class GridBand::FineLines : public relief::CellLines {
public:
    explicit FineLines(const GridBand& band) : band_(band) {}
    void cross(int column, int row, const glm::dvec2& range, relief::CellCrossings& found) const override {
        found.crossings.clear();
        const std::uint32_t slot = band_.slots_[band_.cell_at(column, row)];
        for (std::uint32_t line = 0; line < lines_of_cell; ++line) {
            found.first[line] = static_cast<std::uint32_t>(found.crossings.size());
            if (slot == no_slot) {
                continue;
            }
            const std::uint32_t* const first = &band_.fine_first_[std::size_t{slot} * lines_of_cell + line];
            for (std::uint32_t k = first[0]; k < first[1]; ++k) {
                const auto w = static_cast<double>(band_.fine_[k].w);
                if (w >= range.x && w <= range.y) {
                    found.crossings.push_back(band_.fine_[k]);
                }
            }
        }
        found.first.back() = static_cast<std::uint32_t>(found.crossings.size());
    }

private:
    const GridBand& band_;
};

std::uint32_t GridBand::take_slot(int column, int row, const glm::vec2& range) {
    std::uint32_t& slot = slots_[cell_at(column, row)];
    if (slot == no_slot) {
        slot = static_cast<std::uint32_t>(slot_ranges_.size());
        slot_ranges_.push_back(range);
    }
    glm::vec2& all = slot_ranges_[slot];
    all = {std::min(all.x, range.x), std::max(all.y, range.y)};
    return slot;
}

void GridBand::find_cut_cells() {
    slots_.assign(lines_.first.size(), no_slot);
    slot_ranges_.clear();
    compared_.clear();
    const CellRecorder recorder(*this);
    relief::CellLinker linker(lines_, recorder);
    constexpr int compared_share = 61; // one cell in 61 is compared
    for (int row = 0; row < band_rows; ++row) {
        for (int column = 0; column + 1 < lines_.columns; ++column) {
            for (const relief::LinkedCell& cell : linker.link(column, row)) {
                if (cell.whole() && (7 * column + 13 * row) % compared_share == 0) {
                    const float w = 0.25F * (cell.w[0] + cell.w[1] + cell.w[2] + cell.w[3]);
                    constexpr auto reach = static_cast<float>(max_compared);
                    compared_.push_back({take_slot(column, row, {w - reach, w + reach}), w});
                }
            }
        }
    }
}

void GridBand::cross_cut_cells(const BandScene& scene) {
    fine_found_.clear();
    if (slot_ranges_.empty()) {
        return;
    }
    for (const Placed& placed : placed_) {
        const GridTriangle& shape = placed.shape;
        const auto [top, bottom] = whole(shape.low().y - 1.0, shape.high().y, band_rows - 1);
        for (int row = top; row <= bottom; ++row) {
            const auto [low, high] = shape.columns(row, row + 1);
            const auto [left, right] = whole(low - 1.0, high, lines_.columns - 2);
            for (int column = left; column <= right; ++column) {
                if (slots_[cell_at(column, row)] != no_slot) {
                    cross_cell(scene, placed, column, row);
                }
            }
        }
    }
}

void GridBand::cross_cell(const BandScene& scene, const Placed& placed, int column, int row) {
    const GridTriangle& shape = placed.shape;
    const std::uint32_t slot = slots_[cell_at(column, row)];
    const glm::vec2 range = slot_ranges_[slot];
    const relief::LineCrossing at = shape.crossing(column + 0.5, row + 0.5);
    const float around = 0.5F * (std::abs(at.slope_u) + std::abs(at.slope_v));
    if (at.w + around < range.x || at.w - around > range.y) {
        return;
    }
    const auto [top, bottom] = whole((shape.low().y - row) * parts, (shape.high().y - row) * parts, parts);
    for (int j = top; j <= bottom; ++j) {
        const double v = row + static_cast<double>(j) / parts;
        const auto [low, high] = shape.columns(v, v);
        const auto [left, right] = whole((low - column) * parts, (high - column) * parts, parts);
        for (int i = left; i <= right; ++i) {
            const double u = column + static_cast<double>(i) / parts;
            if (!shape.holds(u, v)) {
                continue;
            }
            const relief::LineCrossing crossing = shape.crossing(u, v);
            if (crossing.w < range.x || crossing.w > range.y) {
                continue;
            }
            if (scene.world.cut_out &&
                !is_solid(surface_colour(scene.world, placed.triangle,
                                         applied(window_from_band_, {u, v, static_cast<double>(crossing.w)}),
                                         glm::dvec3(window_from_band_[2])))) {
                continue;
            }
            fine_found_.push_back(
                {slot * lines_of_cell + static_cast<std::uint32_t>(relief::CellCrossings::line(i, j)),
                 crossing});
        }
    }
}

void GridBand::sort_cut_cells() {
    fine_first_.assign(slot_ranges_.size() * lines_of_cell + 1, 0);
    for (const FineFound& found : fine_found_) {
        ++fine_first_[found.line + 1];
    }
    for (std::size_t k = 1; k < fine_first_.size(); ++k) {
        fine_first_[k] += fine_first_[k - 1];
    }
    order_.assign(fine_first_.begin(), fine_first_.end());
    fine_.resize(fine_found_.size());
    for (const FineFound& found : fine_found_) {
        // Inserts it into its line, behind crossings that are as high or higher.
        const std::uint32_t first = fine_first_[found.line];
        std::uint32_t at = order_[found.line]++;
        for (; at > first && fine_[at - 1].w < found.crossing.w; --at) {
            fine_[at] = fine_[at - 1];
        }
        fine_[at] = found.crossing;
    }
}

void GridBand::compare(Roughness& roughness) const {
    constexpr auto middle = static_cast<std::uint32_t>(
        relief::CellCrossings::line(relief::CellCrossings::parts / 2, relief::CellCrossings::parts / 2));
    for (const Compared& compared : compared_) {
        const std::size_t line = std::size_t{compared.slot} * lines_of_cell + middle;
        float least = std::numeric_limits<float>::infinity();
        for (std::uint32_t k = fine_first_[line]; k < fine_first_[line + 1]; ++k) {
            least = std::min(least, std::abs(fine_[k].w - compared.w));
        }
        if (std::isfinite(least)) {
            const double off = std::min(max_compared, static_cast<double>(least));
            roughness.squares += off * off;
            ++roughness.lines;
        }
    }
}

void GridBand::link(int band, relief::DirectionBlocks& into) {
    const FineLines fine(*this);
    relief::CellLinker linker(lines_, fine);
    const std::size_t before = into.blocks.size();
    for (int column = 0; column + relief::block_cells < lines_.columns; column += relief::block_cells) {
        const auto has_own = [&](int row) {
            return std::any_of(lines_.crossings.data() + lines_.first[lines_.line(column, row)],
                               lines_.crossings.data() +
                                   lines_.first[lines_.line(column + relief::block_cells, row) + 1],
                               [](const relief::Crossing& crossing) { return crossing.own; });
        };
        bool any = false;
        for (int row = 0; row <= band_rows && !any; ++row) {
            any = has_own(row);
        }
        if (any) {
            relief::link_blocks(into, linker, lines_, column, 0);
        }
    }
    for (std::size_t k = before; k < into.blocks.size(); ++k) {
        into.blocks[k].v0 += static_cast<float>(band * band_rows);
    }
}

} // namespace frustumscreen::ldi
