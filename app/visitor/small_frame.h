/// A camera's frame made small: blocks of its pixels averaged, until it has at most 320 columns. A head at the table is 20 to 50 of
/// them wide, and noise is less in the average.
///
/// Units    luma codes.
/// Threads  pure; any.
#pragma once

#include "firmware_host/camera/camera.h"

#include <vector>

namespace frustumscreen {

struct SmallFrame {
    static constexpr int most_columns = 320;
    int width = 0, height = 0;
    std::vector<float> luma; ///< [height][width], row-major

    [[nodiscard]] std::size_t at(int row, int column) const {
        return static_cast<std::size_t>(row) * static_cast<std::size_t>(width) +
               static_cast<std::size_t>(column);
    }
};

/// How many columns and rows of a frame with so many columns make one.
[[nodiscard]] int block_of(int columns);
/// Columns and rows that fill no block are left out. Reuses the memory of `small`.
void shrink(const CameraFrame& frame, SmallFrame& small);

} // namespace frustumscreen
