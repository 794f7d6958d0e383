/// Measures the time from a picture's light to a camera frame that shows it and nothing of the picture
/// before: the sum of the delays of projector, exposure, row readout and time stamps.
///
/// Method   The projector alternates white and black. For each change, the first frame from which on every
///          part of the picture has settled is found. The longest time to it is the delay: a frame with a
///          later time stamp is good.
/// Time     a parameter; frames have the time that the kernel gave them.
/// Threads  pure; any.
#pragma once

#include "app/calibration/gray_code.h"
#include "firmware_host/base/time.h"
#include "firmware_host/camera/camera.h"

#include <array>

namespace frustumscreen::calibration {

class CaptureDelay {
public:
    static constexpr Nanoseconds settled = std::chrono::milliseconds(600);
    static constexpr int changes = 6;
    static constexpr double min_swing = 20.0; ///< grey levels of 255, in the part that changes most

    /// The pattern to show.
    [[nodiscard]] Pattern pattern() const { return {change_ % 2 == 0 ? Stripes::White : Stripes::Black}; }
    /// `lit`: the time since which the pattern is lit; nothing: it is not lit yet.
    void step(std::optional<MonotonicTime> lit, const camera::CameraFrame* frame);

    [[nodiscard]] bool is_done() const { return change_ > changes; }
    /// The delay, once done; nothing if the camera does not see the projector's light.
    [[nodiscard]] std::optional<Nanoseconds> delay() const {
        return swing_ >= min_swing ? std::optional(delay_) : std::nullopt;
    }

private:
    static constexpr int columns = 16;
    static constexpr int rows = 12;
    using Parts = std::array<double, columns * rows>; ///< mean of each part
    struct Look {
        MonotonicTime time;
        Parts parts;
    };
    [[nodiscard]] static Parts parts_of(const camera::CameraFrame& frame);
    void judge(MonotonicTime lit);

    int change_ = 0; ///< 0: the first white, before any change
    std::vector<Look> looks_;
    Parts before_{};
    double swing_ = 0.0;
    Nanoseconds delay_{0};
};

} // namespace frustumscreen::calibration
