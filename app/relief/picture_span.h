/// A view of texels in memory that it does not own.
///
/// Shape    row 0 at the top, `stride` texels from row to row.
/// Threads  values; any.
#pragma once

#include <cstddef>

namespace frustumscreen::relief {

template <typename Texel> struct PictureSpan {
    Texel* first = nullptr;
    int width = 0, height = 0;
    std::ptrdiff_t stride = 0;

    [[nodiscard]] Texel& at(int x, int y) const { return first[y * stride + x]; }
};

} // namespace frustumscreen::relief
