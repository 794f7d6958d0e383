#include "app/visitor/visitor_tracker.h"

namespace frustumscreen::visitor {

void VisitorTracker::use(const camera::CameraFrame& frame) {
    const std::uint64_t misshapen = reader_.counts().misshapen;
    mailbox_.put(reader_.read(frame));
    misshapen_ = reader_.counts().misshapen > misshapen;
}

std::string_view VisitorTracker::trouble() const {
    return misshapen_
               ? "the camera's frames have another aspect ratio than in the settings, so no visitor is seen; "
                 "set camera.width and camera.height to a size that frustumscreen camera lists"
               : std::string_view{};
}

} // namespace frustumscreen::visitor
