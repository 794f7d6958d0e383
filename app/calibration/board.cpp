#include "app/calibration/board.h"

#include <fmt/format.h>

#include <cmath>

namespace frustumscreen::calibration {

namespace {

/// Skirt tags are usually numbered from 0, so these ids hardly collide with them.
constexpr int first_id = 570;
constexpr double largest_m = 0.05;
constexpr double min_m = 0.025;
/// Size with the white rim that a tag needs, over its black square.
constexpr double rim = 1.25;
/// The paper's margin that no printer reaches.
constexpr double margin_m = 0.008;
constexpr double beside_prop_m = 0.001;
constexpr double around_top_m = 0.002;

/// Rounds down to whole millimetres, so that a ruler can check it.
double whole_mm(double metres) {
    return std::floor(1e3 * metres + 1e-9) / 1e3;
}

/// The largest tag that fits a space with its rim.
double fitting(double space_m) {
    return whole_mm(std::fmin(largest_m, space_m / rim));
}

tags::PropTag flat_tag(int id, double size_m, const glm::dvec3& middle) {
    return {id, size_m, {{1.0, 0.0, 0.0, 0.0}, middle}};
}

} // namespace

Result<Board> board_for(const geometry::FrustumSize& prop) {
    const glm::dvec2 reach = 0.5 * Board::size_m - margin_m;
    const glm::dvec2 band = reach - 0.5 * prop.base_m - beside_prop_m;
    const double in_ring = fitting(std::fmin(band.x, band.y));
    const double in_columns = fitting(std::fmin(band.x, 2.0 * reach.y / 5.0));
    const double size = std::fmax(in_ring, in_columns);
    if (size < min_m) {
        return fail(ErrorKind::BadConfiguration, "board.prop_too_wide",
                    "the prop's bottom is {:.0f} mm wide, which leaves no room for tags on a sheet of A3; "
                    "allowed are at most {:.0f} mm",
                    1e3 * prop.base_m, 2e3 * (reach.x - beside_prop_m - rim * min_m));
    }
    const double on_top = whole_mm(std::fmin(1.6 * largest_m, (prop.top_m - 2.0 * around_top_m) / rim));
    if (on_top < min_m) {
        return fail(
            ErrorKind::BadConfiguration, "board.top_too_small",
            "the prop's top is {:.0f} mm wide, which is too small for a tag; allowed are at least {:.0f} mm",
            1e3 * prop.top_m, 1e3 * (rim * min_m + 2.0 * around_top_m));
    }
    const glm::dvec2 far = reach - 0.5 * rim * size;
    Board board{prop, {}};
    const auto add = [&](double x, double y) {
        board.tags.push_back(
            flat_tag(first_id + static_cast<int>(board.tags.size()), size, {x * far.x, y * far.y, 0.0}));
    };
    if (in_ring + 1e-9 >= in_columns) {
        for (const double y : {1.0, -1.0}) {
            for (const double x : {-1.0, -1.0 / 3.0, 1.0 / 3.0, 1.0}) {
                add(x, y);
            }
        }
        add(-1.0, 0.0);
        add(1.0, 0.0);
    } else {
        for (const double x : {-1.0, 1.0}) {
            for (const double y : {1.0, 0.5, 0.0, -0.5, -1.0}) {
                add(x, y);
            }
        }
    }
    board.tags.push_back(
        flat_tag(first_id + static_cast<int>(board.tags.size()), on_top, {0.0, 0.0, prop.height_m}));
    return board;
}

} // namespace frustumscreen::calibration
