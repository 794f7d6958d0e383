#include "app/ldi/eye_cells.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace frustumscreen::ldi {

namespace {

/// An eye so far beyond a border, in cells and as a multiple of its distance, still belongs to the cell.
constexpr double cells_beyond = 1.0, times_beyond = 1.2;

} // namespace

EyeCells::EyeCells(const Hemisphere& hemisphere, std::size_t patch)
    : radius_m_(hemisphere.radius_m()), directions_(hemisphere.directions_of(patch)), is_centre_(patch == 0),
      rows_(is_centre_ ? 2 : 4), columns_(is_centre_ ? 8 : 4) {}

CellMask EyeCells::cell_of(const glm::dvec3& eye) const {
    const double length = glm::length(eye);
    const double share = length / radius_m_;
    if (!(share >= min_eye_share / times_beyond && share <= max_eye_share * times_beyond)) {
        return all_cells;
    }
    const double polar = std::acos(std::clamp(eye.z / length, -1.0, 1.0));
    const double azimuth =
        std::remainder(std::atan2(eye.y, eye.x) - directions_.middle_azimuth_rad, 2.0 * std::numbers::pi);
    const double row =
        rows_ * (polar - directions_.min_polar_rad) / (directions_.max_polar_rad - directions_.min_polar_rad);
    const double column = columns_ * (0.5 + 0.5 * azimuth / directions_.half_width_rad);
    if (!(row >= -cells_beyond && row <= rows_ + cells_beyond && column >= -cells_beyond &&
          column <= columns_ + cells_beyond)) {
        return all_cells;
    }
    const auto in = [](double place, int count) { return std::clamp(static_cast<int>(place), 0, count - 1); };
    return static_cast<CellMask>(
        1U << static_cast<unsigned>(in(row, rows_) * columns_ + in(column, columns_)));
}

glm::dvec3 EyeCells::direction(int row, int column) const {
    const double polar =
        std::lerp(directions_.min_polar_rad, directions_.max_polar_rad, static_cast<double>(row) / rows_);
    const double azimuth = directions_.middle_azimuth_rad +
                           directions_.half_width_rad * (2.0 * static_cast<double>(column) / columns_ - 1.0);
    return {std::sin(polar) * std::cos(azimuth), std::sin(polar) * std::sin(azimuth), std::cos(polar)};
}

CellMask EyeCells::cells_around(int row, int column) const {
    unsigned cells = 0;
    for (int y = std::max(row - 1, 0); y <= std::min(row, rows_ - 1); ++y) {
        for (int x = column - 1; x <= column; ++x) {
            if (is_centre_ || (x >= 0 && x < columns_)) { // the centre's columns go all around
                cells |= 1U << static_cast<unsigned>(y * columns_ + (x + columns_) % columns_);
            }
        }
    }
    return static_cast<CellMask>(cells);
}

std::vector<EyeCells::Corner> EyeCells::corners() const {
    std::vector<Corner> corners;
    const auto add = [&](const glm::dvec3& toward, CellMask cells) {
        for (const double share : {min_eye_share, max_eye_share}) {
            corners.push_back({share * radius_m_ * toward, cells});
        }
    };
    if (is_centre_) {
        add(direction(0, 0), static_cast<CellMask>((1U << static_cast<unsigned>(columns_)) - 1U));
    }
    for (int row = is_centre_ ? 1 : 0; row <= rows_; ++row) {
        for (int column = 0; column < columns_ + (is_centre_ ? 0 : 1); ++column) {
            add(direction(row, column), cells_around(row, column));
        }
    }
    return corners;
}

} // namespace frustumscreen::ldi
