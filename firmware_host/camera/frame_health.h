/// Frame health: whether a camera's frames are usable, or covered, blinded, frozen, slow or silent.
///
/// Dark     the brightest hundredth is dark and the picture has no contrast: covered, or without light.
/// Blinded  half of the picture has the largest code; or all of it is equally bright, close to that.
/// Frozen   the same bytes for a second and ten frames. A sensor's noise changes some code in each frame. In
///          a dark or blinded picture it may not, so Dark and Blinded take precedence. A static, noiseless
///          test pattern is reported as frozen too.
/// Slow     in the last two seconds fewer than half of the frames at the announced rate.
/// Silent   no frame for a second, or for the time of five frames.
/// Each verdict, and its end, is reported once it has lasted for `dwell`.
///
/// Time     a parameter throughout, monotonic.
/// Threads  one caller.
#pragma once

#include "firmware_host/base/time.h"

#include <cstdint>
#include <deque>
#include <span>

namespace frustumscreen::camera {

/// Statistics of a frame.
struct FrameLook {
    std::uint8_t darkest = 0;   ///< a hundredth of the pixels are darker
    std::uint8_t median = 0;    ///< half of the pixels are darker
    std::uint8_t brightest = 0; ///< a hundredth of the pixels are brighter
    std::uint64_t bytes_hash = 0;
};
[[nodiscard]] FrameLook look_at(std::span<const std::uint8_t> luma);

enum class FrameVerdict : std::uint8_t { Well, Slow, Dark, Blinded, Frozen, Silent };

class FrameHealth {
public:
    static constexpr Nanoseconds dwell = std::chrono::milliseconds(500);
    static constexpr Nanoseconds rate_window = std::chrono::seconds(2);
    static constexpr Nanoseconds frozen_after = std::chrono::seconds(1);
    static constexpr int frozen_frames = 10;
    /// Time that cameras may take to send their first frame.
    static constexpr Nanoseconds first_frame = std::chrono::seconds(2);

    /// `rate_hz`: the negotiated rate, above 0.
    FrameHealth(double rate_hz, MonotonicTime start);

    /// Reports frames that were not looked at.
    void hear(MonotonicTime now, std::uint64_t frames);
    /// Reports a frame. `overtaken`: earlier frames that came with it and were not looked at.
    void see(MonotonicTime now, const FrameLook& look, std::uint64_t overtaken = 0);
    /// Call it regularly, also while no frames come.
    [[nodiscard]] FrameVerdict verdict(MonotonicTime now);
    /// Rate of the frames of the last two seconds, per second.
    [[nodiscard]] double rate_hz(MonotonicTime now);

private:
    [[nodiscard]] FrameVerdict at_the_moment(MonotonicTime now);
    void forget_before(MonotonicTime now);

    double promised_hz_;
    Nanoseconds silence_;
    MonotonicTime silent_from_; ///< unless a frame comes before
    MonotonicTime counted_since_;
    std::deque<MonotonicTime> arrivals_; ///< those of the last two seconds, since `counted_since_`
    FrameLook look_;
    MonotonicTime same_since_;
    int same_frames_ = 0;
    FrameVerdict verdict_ = FrameVerdict::Well;
    FrameVerdict candidate_ = FrameVerdict::Well;
    MonotonicTime candidate_since_;
};

} // namespace frustumscreen::camera
