/// The captures of one rest: each striped picture is shown until the camera has surely seen it, and its frames are averaged.
///
/// Order    a white picture, then those of gray_code.h, which end with another white one and a black one: what moved meanwhile shows between the two.
/// Time     a parameter; frames have the time that the kernel gave them.
/// Threads  pure; any.
#pragma once

#include "app/calibration/gray_code.h"
#include "firmware_host/base/time.h"
#include "firmware_host/camera/camera.h"

#include <algorithm>

namespace frustumscreen {

struct CaptureSetup {
    StripeSetup stripes;
    Nanoseconds delay{}; ///< CaptureDelay
    int frames = 2;      ///< of each picture
};

class StripeCapture {
public:
    static constexpr Nanoseconds patience = std::chrono::seconds(3); ///< for a frame

    StripeCapture(const CaptureSetup& setup, MonotonicTime now);

    /// What is to be shown.
    [[nodiscard]] Pattern pattern() const { return patterns_[std::min(at_, patterns_.size() - 1)]; }
    /// `lit`: since when that is shown; nothing: it is not yet. False: no frame comes, or frames of another size.
    [[nodiscard]] bool step(MonotonicTime now, std::optional<MonotonicTime> lit, const CameraFrame* frame);
    [[nodiscard]] bool is_complete() const { return at_ == patterns_.size(); }

    /// The first white one is there.
    [[nodiscard]] bool has_before() const { return at_ > 0; }
    [[nodiscard]] CameraFrame before() const; ///< that one, without a time
    /// Of a complete one.
    [[nodiscard]] CameraFrame after() const;
    [[nodiscard]] Captures captures() const;

private:
    [[nodiscard]] CameraFrame picture(std::size_t which) const;

    CaptureSetup setup_;
    std::vector<Pattern> patterns_;
    std::vector<std::vector<std::uint8_t>> pictures_;
    int width_ = 0;
    int height_ = 0;
    std::size_t at_ = 0;
    std::vector<std::uint16_t> sum_; ///< of the frames of the picture that is shown
    int summed_ = 0;
    MonotonicTime heard_; ///< the last frame
};

} // namespace frustumscreen
