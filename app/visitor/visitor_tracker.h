/// Who stands at the table, seen by a camera with nothing on their heads. What the camera's thread sees waits here for the render thread.
///
/// Frames   table T, metres.
/// Threads  `use` is for the camera's thread; all else for one caller, which waits for nothing. No frame leaves the camera's thread.
/// Errors   none; `trouble` says what is the matter.
#pragma once

#include "app/visitor/visitor_reader.h"
#include "firmware_host/base/mailbox.h"

#include <atomic>
#include <string_view>
#include <vector>

namespace frustumscreen {

class VisitorTracker {
public:
    explicit VisitorTracker(VisitorSetUp set_up) : reader_(std::move(set_up)) {}

    void use(const CameraFrame& frame);
    /// Appends every head with time <= now that was not handed out before, in ascending time.
    void poll(MonotonicTime now, std::vector<SeenHead>& heads) { mailbox_.take(now, heads); }
    /// In one plain sentence; empty: there is none.
    [[nodiscard]] std::string_view trouble() const;

private:
    VisitorReader reader_; ///< the camera's thread only
    Mailbox<SeenHead, 32> mailbox_;
    std::atomic<bool> misshapen_{false};
};

} // namespace frustumscreen
