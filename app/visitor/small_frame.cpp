#include "app/visitor/small_frame.h"

#include <cstdint>

namespace frustumscreen::visitor {

int block_of(int columns) {
    return (columns + SmallFrame::max_columns - 1) / SmallFrame::max_columns;
}

void shrink(const camera::CameraFrame& frame, SmallFrame& small) {
    const int block = block_of(frame.width);
    small.width = frame.width / block;
    small.height = frame.height / block;
    small.luma.resize(static_cast<std::size_t>(small.width) * static_cast<std::size_t>(small.height));
    const float share = 1.0F / static_cast<float>(block * block);
    for (int row = 0; row < small.height; ++row) {
        for (int column = 0; column < small.width; ++column) {
            int sum = 0;
            for (int y = row * block; y < (row + 1) * block; ++y) {
                const std::uint8_t* const luma =
                    frame.luma.data() + static_cast<std::ptrdiff_t>(y) * frame.width + column * block;
                for (int x = 0; x < block; ++x) {
                    sum += luma[x];
                }
            }
            small.luma[small.at(row, column)] = share * static_cast<float>(sum);
        }
    }
}

} // namespace frustumscreen::visitor
