#include "app/ldi/grid_band.h"

#include "app/ldi/surface_colour.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace frustumscreen::ldi {

namespace {

constexpr int band_rows = relief::block_cells;
constexpr std::uint32_t no_slot = std::numeric_limits<std::uint32_t>::max();
constexpr int parts = relief::CellCrossings::parts;
constexpr std::uint32_t lines_of_cell =
    relief::CellCrossings::lines_along * relief::CellCrossings::lines_along;
/// A place this much behind what a camera sees still counts as seen.
constexpr double seen_behind = 1.5; // texels
/// Crossings nearer to each other are one, of triangles that coincide.
constexpr float min_distance = 1e-4F; // texels
/// A larger distance from the relief is a gap between two surfaces, which finer texels would not close.
constexpr double max_compared = 4.0; // texels

glm::dvec3 applied(const glm::dmat4& matrix, const glm::dvec3& point) {
    return glm::dvec3(matrix[0]) * point.x + glm::dvec3(matrix[1]) * point.y +
           glm::dvec3(matrix[2]) * point.z + glm::dvec3(matrix[3]);
}

/// Whole numbers within two bounds, and within 0 and `max`.
std::pair<int, int> whole(double low, double high, int max) {
    const double first = std::max(0.0, std::ceil(low));
    const double last = std::min(static_cast<double>(max), std::floor(high));
    return first <= last ? std::pair(static_cast<int>(first), static_cast<int>(last)) : std::pair(1, 0);
}

} // namespace

/// Asks for cells instead of answering.
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

bool GridBand::make(const BandScene& scene, int band, std::span<const FacingTriangle> facing,
                    std::span<const std::uint32_t> triangles, relief::DirectionBlocks& into,
                    Roughness& roughness) {
    place(scene, band, facing, triangles);
    cross(scene, band);
    sort();
    drop_hidden();
    find_cut_cells(scene);
    constexpr std::uint64_t bytes_of_cell =
        3 * lines_of_cell * (sizeof(FineFound) + sizeof(relief::LineCrossing)) / 2;
    if (bytes_of_cell * slot_ranges_.size() > scene.max_bytes) {
        return false;
    }
    cross_cut_cells(scene);
    sort_cut_cells();
    compare(roughness);
    link(band, into);
    return true;
}

std::uint64_t GridBand::bytes() const {
    return grown_bytes() + placed_.capacity() * sizeof(Placed);
}

std::uint64_t GridBand::grown_bytes() const {
    const auto bytes = [](const auto& values) { return values.capacity() * sizeof(values[0]); };
    return bytes(found_) + bytes(order_) + bytes(lines_.first) + bytes(lines_.crossings) + bytes(placed_of_) +
           bytes(slots_) + bytes(fine_found_) + bytes(fine_first_) + bytes(fine_) + bytes(compared_);
}

void GridBand::place(const BandScene& scene, int band, std::span<const FacingTriangle> facing,
                     std::span<const std::uint32_t> triangles) {
    placed_.clear();
    glm::dmat4 band_from_window = scene.grid.grid_from_window;
    band_from_window[3].y -= double(band) * band_rows;
    for (const std::uint32_t k : triangles) {
        std::array<glm::dvec3, 3> corners{};
        for (std::size_t corner = 0; corner < 3; ++corner) {
            const std::uint32_t index = scene.world.indices[3 * std::size_t{facing[k].triangle} + corner];
            corners[corner] = applied(band_from_window, glm::dvec3(scene.world.positions[index]));
        }
        if (const std::optional<GridTriangle> shape = GridTriangle::make(corners)) {
            placed_.push_back({*shape, facing[k].triangle, (facing[k].own >> scene.direction & 1U) != 0});
        }
    }
}

void GridBand::cross(const BandScene& scene, int band) {
    found_.clear();
    lines_.grid = scene.grid.grid;
    lines_.columns = scene.grid.columns;
    lines_.rows = band_rows + 1;
    window_from_band_ = scene.grid.window_from_grid;
    window_from_band_[3] += window_from_band_[1] * (double(band) * band_rows);
    for (std::uint32_t k = 0; k < placed_.size(); ++k) {
        const GridTriangle& shape = placed_[k].shape;
        const auto [top, bottom] = whole(shape.low().y, shape.high().y, band_rows);
        for (int row = top; row <= bottom; ++row) {
            const auto [low, high] = shape.columns(row, row);
            const auto [left, right] = whole(low, high, lines_.columns - 1);
            // Most of a large triangle may be hidden.
            constexpr int run = 8;
            for (int first = left; first <= right; first += run) {
                const int last = std::min(right, first + run - 1);
                const auto point = [&](int column) {
                    return applied(window_from_band_,
                                   {column, row, static_cast<double>(shape.crossing(column, row).w)});
                };
                if (right - left < run || may_be_seen_between(scene.views, scene.cameras, point(first),
                                                              point(last), 2.0 * run * scene.texel_m)) {
                    cross_run(scene, k, row, first, last);
                }
            }
        }
    }
}

void GridBand::cross_run(const BandScene& scene, std::uint32_t placed, int row, int left, int right) {
    const GridTriangle& shape = placed_[placed].shape;
    const double margin_m = 3.0 * scene.texel_m;
    for (int column = left; column <= right; ++column) {
        if (!shape.holds(column, row)) {
            continue;
        }
        Found found{static_cast<std::uint32_t>(lines_.line(column, row)), placed, {}};
        static_cast<relief::LineCrossing&>(found.crossing) = shape.crossing(column, row);
        const glm::dvec3 point =
            applied(window_from_band_, {column, row, static_cast<double>(found.crossing.w)});
        if (scene.view.clip().beyond(point, margin_m) != 0) {
            continue;
        }
        if (scene.world.cut_out) {
            found.crossing.colour = surface_colour(scene.world, placed_[placed].triangle, point,
                                                   glm::dvec3(window_from_band_[2]));
            if (!is_solid(found.crossing.colour)) {
                continue;
            }
            found.crossing.colour.a = 255;
        }
        found.crossing.own = placed_[placed].own && scene.view.clip().beyond(point, scene.texel_m) == 0 &&
                             may_be_seen(scene.views, scene.cameras, point, seen_behind * scene.texel_m);
        found_.push_back(found);
    }
}

void GridBand::sort() {
    lines_.first.assign(static_cast<std::size_t>(lines_.columns) * (band_rows + 1) + 1, 0);
    for (const Found& found : found_) {
        ++lines_.first[found.line + 1];
    }
    for (std::size_t k = 1; k < lines_.first.size(); ++k) {
        lines_.first[k] += lines_.first[k - 1];
    }
    order_.resize(found_.size());
    std::vector<std::uint32_t>& next = slots_; // free until the cells get slots
    next.assign(lines_.first.begin(), lines_.first.end() - 1);
    for (std::uint32_t k = 0; k < found_.size(); ++k) {
        order_[next[found_[k].line]++] = k;
    }
    lines_.crossings.clear();
    placed_of_.clear();
    for (std::size_t line = 0; line + 1 < lines_.first.size(); ++line) {
        const std::span<std::uint32_t> of_line(order_.data() + lines_.first[line],
                                               lines_.first[line + 1] - lines_.first[line]);
        for (std::size_t k = 1; k < of_line.size(); ++k) { // stable
            for (std::size_t at = k;
                 at > 0 && found_[of_line[at - 1]].crossing.w < found_[of_line[at]].crossing.w; --at) {
                std::swap(of_line[at - 1], of_line[at]);
            }
        }
        const std::size_t begin = lines_.crossings.size();
        for (const std::uint32_t k : of_line) {
            const relief::Crossing& crossing = found_[k].crossing;
            if (lines_.crossings.size() > begin && lines_.crossings.back().w - crossing.w < min_distance) {
                lines_.crossings.back().own |= crossing.own;
                continue;
            }
            lines_.crossings.push_back(crossing);
            placed_of_.push_back(found_[k].placed);
        }
        lines_.first[line] = static_cast<std::uint32_t>(begin);
    }
    lines_.first.back() = static_cast<std::uint32_t>(lines_.crossings.size());
}

void GridBand::drop_hidden() {
    std::vector<bool>& kept = coloured_; // free until the crossings get colours
    kept.assign(lines_.crossings.size(), false);
    for (int row = 0; row <= band_rows; ++row) {
        for (int column = 0; column < lines_.columns; ++column) {
            const std::size_t line = lines_.line(column, row);
            for (std::uint32_t k = lines_.first[line]; k < lines_.first[line + 1]; ++k) {
                const relief::Crossing& own = lines_.crossings[k];
                if (!own.own) {
                    continue;
                }
                // More than what linked_cells.cpp allows between neighbours on smooth surfaces.
                const float reach = 4.0F + 2.0F * (std::abs(own.slope_u) + std::abs(own.slope_v));
                for (int y = std::max(0, row - 1); y <= std::min(band_rows, row + 1); ++y) {
                    const std::uint32_t first = lines_.first[lines_.line(std::max(0, column - 1), y)];
                    const std::uint32_t end =
                        lines_.first[lines_.line(std::min(lines_.columns - 1, column + 1), y) + 1];
                    for (std::uint32_t other = first; other < end; ++other) {
                        if (std::abs(lines_.crossings[other].w - own.w) < reach) {
                            kept[other] = true;
                        }
                    }
                }
            }
        }
    }
    std::uint32_t count = 0;
    std::uint32_t begin = 0;
    for (std::size_t line = 0; line + 1 < lines_.first.size(); ++line) {
        const std::uint32_t end = lines_.first[line + 1];
        const std::uint32_t first = count;
        for (std::uint32_t k = begin; k < end; ++k) {
            if (kept[k]) {
                lines_.crossings[count] = lines_.crossings[k];
                placed_of_[count] = placed_of_[k];
                ++count;
            }
        }
        begin = end;
        lines_.first[line] = first;
    }
    lines_.first.back() = count;
    lines_.crossings.resize(count);
    placed_of_.resize(count);
}

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

void GridBand::find_cut_cells(const BandScene& scene) {
    slots_.assign(lines_.first.size(), no_slot);
    slot_ranges_.clear();
    compared_.clear();
    coloured_.assign(lines_.crossings.size(), scene.world.cut_out);
    const CellRecorder recorder(*this);
    relief::CellLinker linker(lines_, recorder);
    constexpr int compared_share = 61; // one of so many cells
    for (int row = 0; row < band_rows; ++row) {
        for (int column = 0; column + 1 < lines_.columns; ++column) {
            for (const relief::LinkedCell& cell : linker.link(column, row)) {
                for (int k = 0; k < 4; ++k) {
                    set_colour(scene, cell.crossing[static_cast<std::size_t>(k)], column + (k & 1),
                               row + (k >> 1));
                }
                if (cell.whole() && (7 * column + 13 * row) % compared_share == 0) {
                    const float w = 0.25F * (cell.w[0] + cell.w[1] + cell.w[2] + cell.w[3]);
                    constexpr auto reach = static_cast<float>(max_compared);
                    compared_.push_back({take_slot(column, row, {w - reach, w + reach}), w});
                }
            }
        }
    }
}

void GridBand::set_colour(const BandScene& scene, std::uint32_t crossing, int column, int row) {
    if (crossing == relief::no_crossing || coloured_[crossing]) {
        return;
    }
    coloured_[crossing] = true;
    const glm::dvec3 point =
        applied(window_from_band_, {column, row, static_cast<double>(lines_.crossings[crossing].w)});
    lines_.crossings[crossing].colour = surface_colour(scene.world, placed_[placed_of_[crossing]].triangle,
                                                       point, glm::dvec3(window_from_band_[2]));
    lines_.crossings[crossing].colour.a = 255;
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
        // Into its line, behind what is higher or as high.
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
