/// The camera's picture, small and grey, for the staff who hold both of their buttons: handed from the camera's
/// thread to the render thread, only while it is wanted.
///
/// Shape    the frame, turned by quarter turns so that it is upright for a viewer at the table's front, and shrunk by
///          a whole number: each pixel is the mean of a square of the frame. A remainder at the right and lower edge
///          is cut off.
/// Memory   while it is not wanted no frame is copied, and the copy is overwritten with zeros: at the call
///          `want(false)`, or at the next call if the camera's thread was writing.
/// Threads  `use`: the camera's. Everything else: the render thread, which never waits and allocates nothing.
/// Errors   none.
#pragma once

#include "app/image/image.h"
#include "app/settings/settings.h"
#include "firmware_host/camera/camera.h"

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <mutex>

namespace frustumscreen::show {

/// The largest part of a projector's picture that it takes, in pixels.
[[nodiscard]] glm::ivec2 viewfinder_area_px(const geometry::Pinhole& projector);

class Viewfinder {
public:
    static constexpr int max_width = 320, max_height = 240;

    /// `area_px`: the largest size of the picture, after the turn. `quarter_turns`: of the frame, clockwise.
    Viewfinder(const glm::ivec2& area_px, int quarter_turns)
        : area_px_(area_px), quarter_turns_(quarter_turns) {}
    explicit Viewfinder(const settings::Settings& settings);

    void use(const camera::CameraFrame& frame);

    /// Call in every frame.
    void want(bool wanted);
    /// Draws the latest frame into the upper part of `picture`, which is as wide as the area and at least as high:
    /// the frame at the middle of the area's lower edge, black around it. False: nothing has changed since the last
    /// call.
    [[nodiscard]] bool take(image::Image8& picture);

private:
    void shrink(const camera::CameraFrame& frame, int by);

    glm::ivec2 area_px_;
    int quarter_turns_;
    std::atomic<bool> wanted_{false};
    bool wiped_ = true; ///< used by the render thread only

    std::mutex mutex_;
    bool changed_ = false;
    glm::ivec2 size_{0};                                                   ///< 0: there is no picture
    std::array<std::uint8_t, std::size_t{max_width} * max_height> luma_{}; ///< [size_.y][size_.x]
};

} // namespace frustumscreen::show
