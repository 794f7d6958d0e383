#include "app/scene/lit_tiles.h"

#include <algorithm>

namespace frustumscreen::scene {

void LitTiles::begin(int picture_width, int picture_height) {
    width_ = picture_width;
    height_ = picture_height;
    constexpr int usual_tile = 16;
    for (tile_ = usual_tile; tile_ * max_tiles < std::max(width_, height_);) {
        tile_ *= 2;
    }
    bounds_ = {};
    count_ = 0;
    for (Row& row : rows_) {
        row.reset();
    }
}

void LitTiles::light(const PixelRectangle& part) {
    const PixelRectangle inside = intersected(part, {.x = 0, .y = 0, .width = width_, .height = height_});
    if (inside.empty()) {
        return;
    }
    bounds_ = united(bounds_, inside);
    const int first_column = inside.x / tile_;
    const int last_column = (inside.x + inside.width - 1) / tile_;
    const int last_row = (inside.y + inside.height - 1) / tile_;
    for (int row = inside.y / tile_; row <= last_row; ++row) {
        for (int column = first_column; column <= last_column; ++column) {
            rows_[static_cast<std::size_t>(row)].set(static_cast<std::size_t>(column));
        }
    }
}

void LitTiles::finish() {
    for (int y = 0; y < height_; y += tile_) {
        const Row& row = rows_[static_cast<std::size_t>(y / tile_)];
        for (int column = 0; column * tile_ < width_; ++column) {
            const int first = column;
            while (column < max_tiles && row.test(static_cast<std::size_t>(column))) {
                ++column;
            }
            if (column > first &&
                !add({.x = first * tile_, .y = y, .width = (column - first) * tile_, .height = tile_})) {
                rectangles_[0] = bounds_;
                count_ = 1;
                return;
            }
        }
    }
}

std::int64_t LitTiles::pixels() const {
    std::int64_t sum = 0;
    for (const PixelRectangle& r : rectangles()) {
        sum += std::int64_t{r.width} * r.height;
    }
    return sum;
}

/// Joins the run to an equal run in the row above; returns false if there is no space.
bool LitTiles::add(const PixelRectangle& run) {
    const PixelRectangle inside = intersected(run, bounds_);
    for (std::size_t k = 0; k < count_; ++k) {
        PixelRectangle& above = rectangles_[k];
        if (above.y + above.height == inside.y && above.x == inside.x && above.width == inside.width) {
            above.height += inside.height;
            return true;
        }
    }
    if (count_ == max_rectangles) {
        return false;
    }
    rectangles_[count_++] = inside;
    return true;
}

} // namespace frustumscreen::scene
