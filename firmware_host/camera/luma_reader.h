/// A camera's bytes into luma: GREY as it is, YUYV's every second byte, MJPEG's brightness alone.
///
/// Bytes    come from outside: whatever they are, nothing is read beyond them or written beyond the frame.
/// Threads  one caller.
#pragma once

#include "firmware_host/camera/v4l2_mode.h"

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace frustumscreen {

class LumaReader {
public:
    LumaReader();
    ~LumaReader();
    LumaReader(LumaReader&&) noexcept;
    LumaReader& operator=(LumaReader&&) noexcept;

    /// False: too few bytes, or no JPEG of this size; `luma` is then of no use. It is resized to [height][width]; bytes behind a
    /// frame are ignored, as cameras pad them.
    [[nodiscard]] bool read(const FrameFormat& format, std::span<const std::byte> bytes,
                            std::vector<std::uint8_t>& luma);

private:
    struct Jpeg;
    std::unique_ptr<Jpeg> jpeg_;
};

} // namespace frustumscreen
