/// The visitors at the table, seen by a camera, without markers on their heads. A mailbox holds the results
/// of the camera's thread for the render thread.
///
/// Frames   table T, metres.
/// Threads  `use`: the camera's thread. Everything else: one caller, which never waits. No frame leaves the
///          camera's thread.
/// Errors   none; `trouble` describes them.
#pragma once

#include "app/visitor/visitor_reader.h"
#include "firmware_host/base/mailbox.h"

#include <atomic>
#include <string_view>
#include <vector>

namespace frustumscreen::visitor {

class VisitorTracker {
public:
    explicit VisitorTracker(VisitorSetUp set_up) : reader_(std::move(set_up)) {}

    void use(const camera::CameraFrame& frame);
    /// Appends every head with time <= now that was not returned yet, in ascending time.
    void poll(MonotonicTime now, std::vector<tracking::SeenHead>& heads) { mailbox_.take(now, heads); }
    /// A fault in one plain sentence; empty: no fault.
    [[nodiscard]] std::string_view trouble() const;

private:
    VisitorReader reader_; ///< the camera's thread only
    Mailbox<tracking::SeenHead, 32> mailbox_;
    std::atomic<bool> misshapen_{false};
};

} // namespace frustumscreen::visitor
