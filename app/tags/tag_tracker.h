/// The prop's second tracker: the tags that a camera sees, found on the camera's own thread. Their poses wait here for the render thread.
///
/// Frames   table T, metres.
/// Threads  `use` is for the camera's thread; all else for one caller, which waits for nothing. No frame leaves the camera's thread.
/// Errors   none; `trouble` says what is the matter.
#pragma once

#include "app/tags/tag_reader.h"
#include "firmware_host/base/mailbox.h"

#include <atomic>
#include <string_view>
#include <utility>
#include <vector>

namespace frustumscreen {

class TagTracker {
public:
    explicit TagTracker(TagSetUp set_up) : reader_(std::move(set_up)) {}

    void use(const CameraFrame& frame);
    /// Appends every pose with time <= now that was not handed out before, in ascending time.
    void poll(MonotonicTime now, std::vector<UncertainPose>& poses) { mailbox_.take(now, poses); }
    /// In one plain sentence; empty: there is none.
    [[nodiscard]] std::string_view trouble() const;

private:
    TagReader reader_; ///< the camera's thread only
    Mailbox<UncertainPose, 16> mailbox_;
    std::atomic<bool> misshapen_{false};
};

} // namespace frustumscreen
