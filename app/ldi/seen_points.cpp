#include "app/ldi/seen_points.h"

#include <algorithm>
#include <numeric>
#include <tuple>
#include <utility>

namespace frustumscreen::ldi {

namespace {

/// So finely a window's picture shows every point that is not hidden.
constexpr int pictures_per_pixel = 2;
/// Points of one square of the image are sorted by what sees them, and stay together: they are drawn near one another.
constexpr std::uint32_t square_px = 32;

PictureCamera fine_picture(const CameraView& view) {
    const auto side = [](int pixels) { return std::min(pictures_per_pixel * pixels, max_picture_side); };
    return camera_through_window({0.0, 0.0, 1.0}, view.half_extent_m, side(view.width), side(view.height));
}

std::pair<std::uint32_t, std::uint32_t> square_of(std::uint32_t place) {
    return {(place >> 16U) / square_px, (place & 0xFFFFU) / square_px};
}

/// The points with these numbers, padded to whole blocks.
template <typename Value> void keep(std::vector<Value>& values, const std::vector<std::uint32_t>& numbers) {
    std::vector<Value> kept;
    kept.reserve((numbers.size() + block_points - 1) / block_points * block_points);
    for (const std::uint32_t number : numbers) {
        kept.push_back(values[number]);
    }
    kept.resize((numbers.size() + block_points - 1) / block_points * block_points);
    values = std::move(kept);
}

} // namespace

SeenPoints::SeenPoints(PointPatch patch, const Hemisphere& hemisphere, std::size_t number,
                       const CameraView& view)
    : patch_(std::move(patch)), colours_(patch_.colours), cells_(patch_.places.size()),
      window_(fine_picture(view)) {
    patch_.cells = EyeCells(hemisphere, number);
    corners_ = patch_.cells.corners();
    // A picture then shows which point is seen where; 0 is no point.
    std::iota(patch_.colours.begin(), patch_.colours.end(), 1U);
}

bool SeenPoints::step() {
    if (next_ == corners_.size()) {
        return false;
    }
    const EyeCells::Corner& corner = corners_[next_++];
    window_.eye = corner.eye;
    for (const std::uint64_t word : splatter_.draw(patch_, window_)) {
        if (const auto number = static_cast<std::uint32_t>(word); number != 0) {
            cells_[number - 1] |= corner.cells;
        }
    }
    return next_ < corners_.size();
}

PointPatch SeenPoints::take() {
    std::vector<std::uint32_t> numbers;
    for (std::uint32_t point = 0; point < cells_.size(); ++point) {
        if (cells_[point] != 0) {
            numbers.push_back(point);
        }
    }
    const auto key = [&](std::uint32_t point) {
        return std::tuple(square_of(patch_.places[point]), cells_[point], point);
    };
    std::sort(numbers.begin(), numbers.end(),
              [&](std::uint32_t a, std::uint32_t b) { return key(a) < key(b); });
    patch_.colours = std::move(colours_);
    keep(patch_.places, numbers);
    keep(patch_.nearness, numbers);
    keep(patch_.slopes, numbers);
    keep(patch_.colours, numbers);
    patch_.seen.assign(patch_.places.size() / block_points, 0);
    for (std::size_t k = 0; k < numbers.size(); ++k) {
        patch_.seen[k / block_points] |= cells_[numbers[k]];
    }
    return std::move(patch_);
}

} // namespace frustumscreen::ldi
