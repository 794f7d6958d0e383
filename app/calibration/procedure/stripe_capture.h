/// Captures one rest: shows each striped picture until the camera has surely seen it, and averages its
/// frames.
/// Order    a white picture, then those of gray_code.h, which end with another white and a black one. A move
///          in between shows as a difference of the two white pictures.
/// Time     a parameter; frames have the time that the kernel gave them.
/// Threads  pure; any.
#pragma once

#include "app/calibration/gray_code.h"
#include "firmware_host/base/time.h"
#include "firmware_host/camera/camera.h"

#include <algorithm>

namespace frustumscreen::calibration {

struct CaptureSetup {
    StripeSetup stripes;
    Nanoseconds delay{}; ///< CaptureDelay
    int frames = 2;      ///< of each picture
};

class StripeCapture {
public:
    static constexpr Nanoseconds timeout = std::chrono::seconds(3); ///< for a frame

    StripeCapture(const CaptureSetup& setup, MonotonicTime now);

    /// The pattern to show.
    [[nodiscard]] Pattern pattern() const { return patterns_[std::min(at_, patterns_.size() - 1)]; }
    /// `lit`: the time since which the pattern is lit; nothing: it is not lit yet. False if no frame comes,
    /// or frames of another size.
    [[nodiscard]] bool step(MonotonicTime now, std::optional<MonotonicTime> lit,
                            const camera::CameraFrame* frame);
    [[nodiscard]] bool is_complete() const { return at_ == patterns_.size(); }

    /// True once the first white picture is captured.
    [[nodiscard]] bool has_before() const { return at_ > 0; }
    [[nodiscard]] camera::CameraFrame before() const; ///< the first white picture, without a time
    /// The second white picture and the captures; both need a complete capture.
    [[nodiscard]] camera::CameraFrame after() const;
    [[nodiscard]] Captures captures() const;

private:
    [[nodiscard]] camera::CameraFrame picture(std::size_t which) const;

    CaptureSetup setup_;
    std::vector<Pattern> patterns_;
    std::vector<std::vector<std::uint8_t>> pictures_;
    int width_ = 0;
    int height_ = 0;
    std::size_t at_ = 0;
    std::vector<std::uint16_t> sum_; ///< of the frames of the shown picture
    int summed_ = 0;
    MonotonicTime heard_; ///< time of the last frame
};

} // namespace frustumscreen::calibration
