#include "app/tags/tag_tracker.h"

#include <span>

namespace frustumscreen::tags {

void TagTracker::use(const camera::CameraFrame& frame) {
    const std::uint64_t misshapen = reader_.counts().misshapen;
    if (const std::optional<tracking::UncertainPose> pose = reader_.read(frame)) {
        mailbox_.put(std::span(&*pose, 1));
    }
    if (const std::optional<tracking::UncertainPose>& lamp = reader_.lamp()) {
        lamp_.put(std::span(&*lamp, 1));
    }
    misshapen_ = reader_.counts().misshapen > misshapen;
}

std::string_view TagTracker::trouble() const {
    return misshapen_
               ? "the camera's frames have another aspect ratio than in the settings, so no tag is read; "
                 "set camera.width and camera.height to a size that frustumscreen camera lists"
               : std::string_view{};
}

} // namespace frustumscreen::tags
