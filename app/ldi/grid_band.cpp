#include "app/ldi/grid_band.h"

#include "app/ldi/surface_colour.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace frustumscreen::ldi {

namespace {

/// A place counts as seen up to this far behind the surface that a camera sees.
constexpr double seen_behind = 1.5; // texels
/// Two crossings nearer than this are one: their triangles coincide.
constexpr float min_distance = 1e-4F; // texels

} // namespace

bool GridBand::make(const BandScene& scene, int band, std::span<const FacingTriangle> facing,
                    std::span<const std::uint32_t> triangles, relief::DirectionBlocks& into,
                    Roughness& roughness) {
    place(scene, band, facing, triangles);
    cross(scene, band);
    sort();
    drop_hidden();
    set_colours(scene);
    find_cut_cells();
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
        for (std::size_t k = 1; k < of_line.size(); ++k) { // stable, so that equal heights keep their order
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
    kept_.assign(lines_.crossings.size(), false);
    for (int row = 0; row <= band_rows; ++row) {
        for (int column = 0; column < lines_.columns; ++column) {
            const std::size_t line = lines_.line(column, row);
            for (std::uint32_t k = lines_.first[line]; k < lines_.first[line + 1]; ++k) {
                const relief::Crossing& own = lines_.crossings[k];
                if (!own.own) {
                    continue;
                }
                // More than linked_cells.cpp allows between neighbours on smooth surfaces.
                const float reach = 4.0F + 2.0F * (std::abs(own.slope_u) + std::abs(own.slope_v));
                for (int y = std::max(0, row - 1); y <= std::min(band_rows, row + 1); ++y) {
                    const std::uint32_t first = lines_.first[lines_.line(std::max(0, column - 1), y)];
                    const std::uint32_t end =
                        lines_.first[lines_.line(std::min(lines_.columns - 1, column + 1), y) + 1];
                    for (std::uint32_t other = first; other < end; ++other) {
                        if (std::abs(lines_.crossings[other].w - own.w) < reach) {
                            kept_[other] = true;
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
            if (kept_[k]) {
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

void GridBand::set_colours(const BandScene& scene) {
    if (scene.world.cut_out) {
        return; // the crossings have their colours already
    }
    for (int row = 0; row <= band_rows; ++row) {
        for (int column = 0; column < lines_.columns; ++column) {
            const std::size_t line = lines_.line(column, row);
            for (std::uint32_t k = lines_.first[line]; k < lines_.first[line + 1]; ++k) {
                relief::Crossing& crossing = lines_.crossings[k];
                const glm::dvec3 point =
                    applied(window_from_band_, {column, row, static_cast<double>(crossing.w)});
                crossing.colour = surface_colour(scene.world, placed_[placed_of_[k]].triangle, point,
                                                 glm::dvec3(window_from_band_[2]));
                crossing.colour.a = 255;
            }
        }
    }
}

} // namespace frustumscreen::ldi
