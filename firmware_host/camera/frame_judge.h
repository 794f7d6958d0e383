/// Whether a camera's frames show anything: covered, blinded, frozen, slow, silent.
///
/// Dark     the brightest hundredth is dark and the picture has no contrast: covered, or there is no light.
/// Blinded  half of the picture is as bright as a code can be; or all of it is equally bright, near that.
/// Frozen   the same bytes for a second and ten frames. A sensor's noise changes some code in each frame; where the picture is dark
///          or blinded it may not, so such a picture is called that and never frozen. A test pattern without noise that stands
///          still is called frozen, rightly or not.
/// Slow     in the last two seconds less than half of the frames that the camera said it would send.
/// Silent   no frame for a second, or for five frames' time.
/// Each is told once it has held for `dwell`, and so is its end.
///
/// Time     a parameter throughout, monotonic.
/// Threads  one caller.
#pragma once

#include "firmware_host/base/time.h"

#include <cstdint>
#include <deque>
#include <span>

namespace frustumscreen {

/// What a frame shows, in a few numbers.
struct FrameLook {
    std::uint8_t darkest = 0;   ///< code that a hundredth of the pixels stay below
    std::uint8_t median = 0;    ///< as many pixels are brighter as are darker
    std::uint8_t brightest = 0; ///< code that a hundredth of the pixels exceed
    std::uint64_t bytes_hash = 0;
};
[[nodiscard]] FrameLook look_at(std::span<const std::uint8_t> luma);

enum class FrameVerdict : std::uint8_t { Well, Slow, Dark, Blinded, Frozen, Silent };

class FrameJudge {
public:
    static constexpr Nanoseconds dwell = std::chrono::milliseconds(500);
    static constexpr Nanoseconds rate_window = std::chrono::seconds(2);
    static constexpr Nanoseconds frozen_after = std::chrono::seconds(1);
    static constexpr int frozen_frames = 10;
    /// Cameras take so long to send their first frame.
    static constexpr Nanoseconds first_frame = std::chrono::seconds(2);

    /// `rate_hz`: as negotiated, above 0.
    FrameJudge(double rate_hz, MonotonicTime start);

    /// Frames came that were not looked at.
    void hear(MonotonicTime now, std::uint64_t frames);
    /// `overtaken`: frames that came with it and were not looked at, because this one was there already.
    void see(MonotonicTime now, const FrameLook& look, std::uint64_t overtaken = 0);
    /// To be asked now and then, also while no frame comes.
    [[nodiscard]] FrameVerdict verdict(MonotonicTime now);
    /// Frames a second, of those that came in the last two seconds.
    [[nodiscard]] double rate_hz(MonotonicTime now);

private:
    [[nodiscard]] FrameVerdict at_the_moment(MonotonicTime now);
    void forget_before(MonotonicTime now);

    double promised_hz_;
    Nanoseconds silence_;
    MonotonicTime silent_from_; ///< if no frame comes until then
    MonotonicTime counted_since_;
    std::deque<MonotonicTime> arrivals_; ///< of the last two seconds, from `counted_since_` on
    FrameLook look_;
    MonotonicTime same_since_;
    int same_frames_ = 0;
    FrameVerdict verdict_ = FrameVerdict::Well;
    FrameVerdict candidate_ = FrameVerdict::Well;
    MonotonicTime candidate_since_;
};

} // namespace frustumscreen
