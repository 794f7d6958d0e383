/// How long after a picture is lit a camera's frame shows it, and nothing of the picture before: projector, exposure, the order in which the
/// camera reads its rows, and its time stamps together.
///
/// Method   The projector shows white and black by turns. After each change the first frame counts from which on every part of the frame is as it
///          stays. The longest such time is the delay: a frame with a later time stamp is good.
/// Time     a parameter; frames have the time that the kernel gave them.
/// Threads  pure; any.
#pragma once

#include "app/calibration/gray_code.h"
#include "firmware_host/base/time.h"
#include "firmware_host/camera/camera.h"

#include <array>

namespace frustumscreen {

class CaptureDelay {
public:
    static constexpr Nanoseconds settled = std::chrono::milliseconds(600);
    static constexpr int changes = 6;
    static constexpr double least_swing = 20.0; ///< grey levels of 255, of the part that changes most

    /// What is to be shown.
    [[nodiscard]] Pattern pattern() const { return {change_ % 2 == 0 ? Stripes::White : Stripes::Black}; }
    /// `lit`: since when that is shown; nothing: it is not yet.
    void step(std::optional<MonotonicTime> lit, const CameraFrame* frame);

    [[nodiscard]] bool is_done() const { return change_ > changes; }
    /// Where it is done; nothing: the camera does not see the projector's light.
    [[nodiscard]] std::optional<Nanoseconds> delay() const {
        return swing_ >= least_swing ? std::optional(delay_) : std::nullopt;
    }

private:
    static constexpr int columns = 16;
    static constexpr int rows = 12;
    using Parts = std::array<double, columns * rows>; ///< the means of its parts
    struct Look {
        MonotonicTime time;
        Parts parts;
    };
    [[nodiscard]] static Parts parts_of(const CameraFrame& frame);
    void judge(MonotonicTime lit);

    int change_ = 0; ///< 0: the first white, which follows nothing
    std::vector<Look> looks_;
    Parts before_{};
    double swing_ = 0.0;
    Nanoseconds delay_{0};
};

} // namespace frustumscreen
