/// A camera's frame reduced to at most 320 columns by averaging blocks of pixels. A head at the table is 20
/// to 50 pixels wide, and the average has less noise.
///
/// Units    luma codes.
/// Threads  pure; any.
#pragma once

#include "firmware_host/camera/camera.h"

#include <vector>

namespace frustumscreen::visitor {

struct SmallFrame {
    static constexpr int max_columns = 320;
    int width = 0, height = 0;
    std::vector<float> luma; ///< [height][width], row-major

    [[nodiscard]] std::size_t at(int row, int column) const {
        return static_cast<std::size_t>(row) * static_cast<std::size_t>(width) +
               static_cast<std::size_t>(column);
    }
};

/// Side of the block of pixels that becomes one pixel, for a frame with `columns` columns.
[[nodiscard]] int block_of(int columns);
/// Incomplete blocks at the right and bottom edges are dropped. Reuses the memory of `small`.
void shrink(const camera::CameraFrame& frame, SmallFrame& small);

} // namespace frustumscreen::visitor
