/// Converts a camera's bytes to luma: GREY unchanged, every second byte of YUYV, only the brightness of
/// MJPEG.
///
/// Bytes    come from outside: whatever they are, no access exceeds them or the frame.
/// Threads  one caller.
#pragma once

#include "firmware_host/camera/v4l2_mode.h"

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace frustumscreen::camera {

class LumaReader {
public:
    LumaReader();
    ~LumaReader();
    LumaReader(LumaReader&&) noexcept;
    LumaReader& operator=(LumaReader&&) noexcept;

    /// Resizes `luma` to [height][width] and fills it. Returns false for too few bytes, or a JPEG of another
    /// size or none; `luma` is then useless. Bytes after a frame are ignored, because cameras pad frames.
    [[nodiscard]] bool read(const FrameFormat& format, std::span<const std::byte> bytes,
                            std::vector<std::uint8_t>& luma);

private:
    struct Jpeg;
    std::unique_ptr<Jpeg> jpeg_;
};

} // namespace frustumscreen::camera
