/// Rectangles of pixels and their sizes.
///
/// Units    whole pixels; x counts columns from the left, y rows from the picture's first.
/// Threads  values; any.
#pragma once

#include <algorithm>

namespace frustumscreen {

struct PixelSize {
    int width = 0, height = 0;
    [[nodiscard]] bool operator==(const PixelSize&) const = default;
};
/// The smallest size that contains both.
[[nodiscard]] inline PixelSize united(const PixelSize& a, const PixelSize& b) {
    return {std::max(a.width, b.width), std::max(a.height, b.height)};
}

struct PixelRectangle {
    int x = 0, y = 0, width = 0, height = 0;
    [[nodiscard]] bool empty() const { return width <= 0 || height <= 0; }
    [[nodiscard]] bool operator==(const PixelRectangle&) const = default;
};

/// The smallest rectangle that contains both; an empty one is ignored.
[[nodiscard]] inline PixelRectangle united(const PixelRectangle& a, const PixelRectangle& b) {
    if (a.empty() || b.empty()) {
        return a.empty() ? b : a;
    }
    const int x = std::min(a.x, b.x);
    const int y = std::min(a.y, b.y);
    return {.x = x,
            .y = y,
            .width = std::max(a.x + a.width, b.x + b.width) - x,
            .height = std::max(a.y + a.height, b.y + b.height) - y};
}

[[nodiscard]] inline PixelRectangle intersected(const PixelRectangle& a, const PixelRectangle& b) {
    const int x = std::max(a.x, b.x);
    const int y = std::max(a.y, b.y);
    return {.x = x,
            .y = y,
            .width = std::min(a.x + a.width, b.x + b.width) - x,
            .height = std::min(a.y + a.height, b.y + b.height) - y};
}

} // namespace frustumscreen
