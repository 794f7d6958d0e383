#include "app/show/viewfinder.h"

#include <algorithm>
#include <cmath>

namespace frustumscreen::show {

namespace {

/// Quarter turns, clockwise from the picture's upper edge, of a direction in a picture whose rows run down.
int quarter_of(const glm::dvec3& direction) {
    if (std::abs(direction.x) > std::abs(direction.y)) {
        return direction.x > 0.0 ? 1 : 3;
    }
    return direction.y > 0.0 ? 2 : 0;
}

/// Quarter turns that put what is higher or farther away at the top, for a viewer at the front who looks down at the
/// table.
int turns_of(const settings::Settings& settings) {
    const settings::CameraSettings& camera = settings.camera;
    if (camera.pinhole.fx <= 0.0 || camera.table_from_camera.translation == glm::dvec3(0.0)) {
        return 0; // the camera's pose has not been measured
    }
    const int in_camera = quarter_of(camera.table_from_camera.inverse().direction({0.0, 1.0, 1.0}));
    const int on_table =
        quarter_of(settings.projector.table_from_projector.inverse().direction({0.0, 1.0, 0.0}));
    return (on_table - in_camera + 4) % 4;
}

/// The frame's pixel that becomes the first of the turned picture, and the steps along a row and a column.
struct Walk {
    glm::ivec2 first, along_row, along_column;
};

Walk walk_of(const glm::ivec2& frame, int quarter_turns) {
    switch (quarter_turns) {
    case 1:
        return {{0, frame.y - 1}, {0, -1}, {1, 0}};
    case 2:
        return {frame - 1, {-1, 0}, {0, -1}};
    case 3:
        return {{frame.x - 1, 0}, {0, 1}, {-1, 0}};
    default:
        return {{0, 0}, {1, 0}, {0, 1}};
    }
}

} // namespace

glm::ivec2 viewfinder_area_px(const geometry::Pinhole& projector) {
    return {std::min(Viewfinder::max_width, projector.width / 3),
            std::min(Viewfinder::max_height, projector.height * 3 / 10)};
}

Viewfinder::Viewfinder(const settings::Settings& settings)
    : Viewfinder(viewfinder_area_px(settings.projector.pinhole), turns_of(settings)) {}

void Viewfinder::use(const camera::CameraFrame& frame) {
    if (!wanted_.load(std::memory_order_relaxed)) {
        return;
    }
    const std::lock_guard lock(mutex_);
    if (!wanted_) { // it is not wanted any more, and the copy was overwritten
        return;
    }
    const bool lies = quarter_turns_ % 2 != 0;
    const glm::ivec2 turned(lies ? frame.height : frame.width, lies ? frame.width : frame.height);
    const glm::ivec2 squares = (turned + area_px_ - 1) / area_px_;
    const int by = std::max({1, squares.x, squares.y});
    size_ = turned / by;
    shrink(frame, by);
    changed_ = true;
}

void Viewfinder::shrink(const camera::CameraFrame& frame, int by) {
    const Walk walk = walk_of({frame.width, frame.height}, quarter_turns_);
    const int pixels = by * by;
    std::size_t next = 0;
    for (int y = 0; y < size_.y; ++y) {
        for (int x = 0; x < size_.x; ++x) {
            int sum = pixels / 2; // for rounding
            for (int k = 0; k < pixels; ++k) {
                const glm::ivec2 at =
                    walk.first + (by * x + k % by) * walk.along_row + (by * y + k / by) * walk.along_column;
                sum += frame.luma[static_cast<std::size_t>(at.y) * static_cast<std::size_t>(frame.width) +
                                  static_cast<std::size_t>(at.x)];
            }
            luma_[next++] = static_cast<std::uint8_t>(sum / pixels);
        }
    }
}

void Viewfinder::want(bool wanted) {
    wanted_ = wanted;
    if (wanted) {
        wiped_ = false;
    } else if (!wiped_) {
        const std::unique_lock lock(mutex_, std::try_to_lock);
        if (lock.owns_lock()) {
            luma_.fill(0);
            size_ = glm::ivec2(0);
            changed_ = true;
            wiped_ = true;
        }
    }
}

bool Viewfinder::take(image::Image8& picture) {
    const std::unique_lock lock(mutex_, std::try_to_lock);
    if (!lock.owns_lock() || !changed_) {
        return false;
    }
    changed_ = false;
    const glm::ivec2 corner((area_px_.x - size_.x) / 2, area_px_.y - size_.y);
    for (int y = 0; y < area_px_.y; ++y) {
        for (int x = 0; x < area_px_.x; ++x) {
            const glm::ivec2 at = glm::ivec2(x, y) - corner;
            const bool is_frame = at.x >= 0 && at.y >= 0 && at.x < size_.x && at.y < size_.y;
            const std::uint8_t code =
                is_frame ? luma_[static_cast<std::size_t>(at.y) * static_cast<std::size_t>(size_.x) +
                                 static_cast<std::size_t>(at.x)]
                         : std::uint8_t{0};
            picture.at(x, y) = {code, code, code, 255};
        }
    }
    return true;
}

} // namespace frustumscreen::show
