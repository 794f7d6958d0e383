/// The prop's second tracker: a camera on whose own thread the tags are found. Its poses wait here for the render thread.
///
/// Frames   table T, metres.
/// Threads  one caller, which waits for nothing; the camera's thread reads the frames. No frame leaves that thread's memory.
/// Errors   none; `state` says what is the matter.
#pragma once

#include "app/tags/tag_reader.h"
#include "firmware_host/base/mailbox.h"

#include <functional>
#include <memory>
#include <string_view>
#include <vector>

namespace frustumscreen {

class TagTracker {
public:
    /// Makes a camera that hands its frames to `use`.
    using MakeCamera = std::function<std::unique_ptr<Camera>(FrameUse use)>;
    TagTracker(TagSetUp set_up, const MakeCamera& make_camera);

    /// Appends every pose with time <= now that was not handed out before, in ascending time.
    void poll(MonotonicTime now, std::vector<UncertainPose>& poses) { mailbox_.take(now, poses); }
    [[nodiscard]] double camera_hz() const { return camera_->rate_hz(); }
    /// In one plain sentence.
    [[nodiscard]] std::string_view state() const;

private:
    void use(const CameraFrame& frame);

    TagReader reader_; ///< the camera's thread only
    Mailbox<UncertainPose, 16> mailbox_;
    std::atomic<bool> misshapen_{false};
    std::unique_ptr<Camera> camera_; ///< last: its thread uses all of the above
};

} // namespace frustumscreen
