/// What the camera sees, small and grey, for the staff who hold both of their buttons: handed from the camera's thread to the render
/// thread, and only while it is wanted.
///
/// Shape    the frame, turned by quarter turns so that it stands upright for who looks at the table from its front, and shrunk by a
///          whole number: each pixel is the mean of a square of the frame's. What is left over at its right and lower edge is left out.
/// Memory   while it is not wanted no frame is copied, and what was copied is zeros: from the call of `want` that says so, or from the
///          next one if the camera's thread was just writing.
/// Threads  `use`: the camera's. All else: the render thread, which waits for nothing and allocates nothing.
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

namespace frustumscreen {

/// The most that it takes of a projector's picture, in pixels.
[[nodiscard]] glm::ivec2 viewfinder_room(const Pinhole& projector);

class Viewfinder {
public:
    static constexpr int max_width = 320, max_height = 240;

    /// `room`: in pixels, after the turn. `quarter_turns`: of the frame, clockwise.
    Viewfinder(const glm::ivec2& room, int quarter_turns) : room_(room), quarter_turns_(quarter_turns) {}
    explicit Viewfinder(const Settings& settings);

    void use(const CameraFrame& frame);

    /// Call in every frame.
    void want(bool wanted);
    /// Draws what it has into the upper part of `picture`, which is as wide as the room and no lower: the frame in the middle of its
    /// lower edge, black around it. False: nothing has changed since.
    [[nodiscard]] bool take(Image8& picture);

private:
    void shrink(const CameraFrame& frame, int by);

    glm::ivec2 room_;
    int quarter_turns_;
    std::atomic<bool> wanted_{false};
    bool wiped_ = true; ///< the render thread's

    std::mutex mutex_;
    bool changed_ = false;
    glm::ivec2 size_{0};                                                   ///< 0: there is no picture
    std::array<std::uint8_t, std::size_t{max_width} * max_height> luma_{}; ///< [size_.y][size_.x]
};

} // namespace frustumscreen
