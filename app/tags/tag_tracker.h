/// The prop's second tracker: tags that a camera sees, found on the camera's own thread. A mailbox holds
/// their poses for the render thread.
///
/// Frames   table T, metres.
/// Threads  `use`: the camera's thread. Everything else: one caller, which never waits. No frame leaves the
///          camera's thread.
/// Errors   none; `trouble` describes them.
#pragma once

#include "app/tags/tag_reader.h"
#include "firmware_host/base/mailbox.h"

#include <atomic>
#include <string_view>
#include <utility>
#include <vector>

namespace frustumscreen::tags {

class TagTracker {
public:
    explicit TagTracker(TagSetUp set_up) : reader_(std::move(set_up)) {}

    void use(const camera::CameraFrame& frame);
    /// Appends every pose with time <= now that was not returned yet, in ascending time.
    void poll(MonotonicTime now, std::vector<tracking::UncertainPose>& poses) { mailbox_.take(now, poses); }
    /// The same of the lamp's poses.
    void poll_lamp(MonotonicTime now, std::vector<tracking::UncertainPose>& poses) { lamp_.take(now, poses); }
    /// A fault in one plain sentence; empty: no fault.
    [[nodiscard]] std::string_view trouble() const;

private:
    TagReader reader_; ///< the camera's thread only
    Mailbox<tracking::UncertainPose, 16> mailbox_;
    Mailbox<tracking::UncertainPose, 16> lamp_;
    std::atomic<bool> misshapen_{false};
};

} // namespace frustumscreen::tags
