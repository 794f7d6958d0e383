/// The flips that a graphics card reports on its file, and whether they keep time with its refreshes.
///
/// Threads  the render thread; `wait` blocks for as long as it is told to.
/// Source   struct drm_event_vblank; DRM_IOCTL_CRTC_GET_SEQUENCE (drm_vblank.c: EINVAL while a mode is being
///          set, EOPNOTSUPP where there are no vertical blanks).
#pragma once

#include "firmware_host/display/kms_device.h"

#include <optional>
#include <vector>

namespace frustumscreen {

class FlipEvents {
public:
    explicit FlipEvents(int card);

    /// From now on only flips of this CRTC count; a commit that turns others off reports theirs too. Whether
    /// flips keep time is asked again after the first one: until then a mode is being set.
    void expect_of(std::uint32_t crtc);
    /// Adds a flip that the card does not report, because the call returned only when it was done.
    void add(const Flipped& flipped) { seen_.push_back(flipped); }
    /// The next flip; waits for it at most `at_most`, 0 = not at all.
    [[nodiscard]] std::optional<Flipped> wait(Nanoseconds at_most);
    [[nodiscard]] bool keep_time() const { return keep_time_.value_or(false); }

private:
    /// False: there was nothing to read.
    bool read();
    void ask_whether_they_keep_time();

    int card_;
    std::uint32_t crtc_ = 0;
    bool monotonic_ = false;
    std::optional<bool> keep_time_; ///< nothing: the kernel could not say yet
    std::vector<Flipped> seen_;     ///< and not handed out yet
};

} // namespace frustumscreen
