#include "app/safe/eye_halves.h"

#include "app/safe/draw_safe_page.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace frustumscreen::safe {

namespace {

/// The code of two pixels' mean light, whose square root is nearly the code.
std::uint8_t mean_of(std::uint8_t a, std::uint8_t b) {
    return static_cast<std::uint8_t>(std::lround(std::sqrt(0.5 * (a * a + b * b))));
}

/// Shrinks a row to its left half, and repeats that in the right one.
void halve(std::span<std::uint8_t> row) {
    const std::size_t half = row.size() / 2;
    for (std::size_t x = 0; x < half; ++x) {
        row[x] = mean_of(row[2 * x], row[2 * x + 1]);
    }
    std::copy_n(row.begin(), half, row.begin() + static_cast<std::ptrdiff_t>(half));
}

/// Row `y` of the picture whose halves are one below the other. `pair`: of two rows.
void draw_row_below(const SafePage& page, int y, std::span<std::uint8_t> row, std::span<std::uint8_t> pair) {
    const int half = page.height / 2;
    draw_safe_rows(page, 2 * (y % half), pair);
    for (std::size_t x = 0; x < row.size(); ++x) {
        row[x] = mean_of(pair[x], pair[row.size() + x]);
    }
}

} // namespace

EyeHalves halves_of(std::string_view stereo) {
    return stereo == "side_by_side" ? EyeHalves::Beside
           : stereo == "top_bottom" ? EyeHalves::Below
                                    : EyeHalves::None;
}

void draw_rows_for_eyes(const SafePage& page, EyeHalves halves, int first_row,
                        std::span<std::uint8_t> greys) {
    const auto width = static_cast<std::size_t>(page.width);
    if (halves != EyeHalves::Below) {
        draw_safe_rows(page, first_row, greys);
    }
    std::vector<std::uint8_t> pair(halves == EyeHalves::Below ? 2 * width : 0);
    for (std::size_t begin = 0; begin < greys.size(); begin += width) {
        const std::span<std::uint8_t> row = greys.subspan(begin, width);
        if (halves == EyeHalves::Beside) {
            halve(row);
        } else if (halves == EyeHalves::Below) {
            draw_row_below(page, first_row + static_cast<int>(begin / width), row, pair);
        }
    }
}

} // namespace frustumscreen::safe
