/// The page flips that a graphics card reports on its file, and whether they keep time with its refreshes.
///
/// Threads  the render thread; `wait` blocks no longer than its limit.
/// Source   struct drm_event_vblank; DRM_IOCTL_CRTC_GET_SEQUENCE (drm_vblank.c: EINVAL while a mode is being
///          set, EOPNOTSUPP without vertical blanks).
#pragma once

#include "firmware_host/display/kms_device.h"

#include <optional>
#include <vector>

namespace frustumscreen::display {

class FlipEvents {
public:
    explicit FlipEvents(int card);

    /// From now on only flips of this CRTC count; a commit that turns other CRTCs off reports their flips
    /// too. Whether flips keep time is checked again after the first flip, because until then a mode is being
    /// set.
    void expect_of(std::uint32_t crtc);
    /// Adds a flip of a blocking call, which the card does not report.
    void add(const Flipped& flipped) { seen_.push_back(flipped); }
    /// The next flip; waits at most `at_most`, 0 = not at all.
    [[nodiscard]] std::optional<Flipped> wait(Nanoseconds at_most);
    [[nodiscard]] bool keep_time() const { return keep_time_.value_or(false); }

private:
    /// Returns false if there was nothing to read.
    bool read();
    void ask_whether_they_keep_time();

    int card_;
    std::uint32_t crtc_ = 0;
    bool monotonic_ = false;
    std::optional<bool> keep_time_; ///< nullopt: not known yet
    std::vector<Flipped> seen_;     ///< not returned yet
};

} // namespace frustumscreen::display
