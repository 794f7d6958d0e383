#include "app/tags/tag_tracker.h"

#include <span>
#include <utility>

namespace frustumscreen {

TagTracker::TagTracker(TagSetUp set_up, const MakeCamera& make_camera)
    : reader_(std::move(set_up)), camera_(make_camera([this](const CameraFrame& frame) { use(frame); })) {}

void TagTracker::use(const CameraFrame& frame) {
    const std::uint64_t misshapen = reader_.counts().misshapen;
    if (const std::optional<UncertainPose> pose = reader_.read(frame)) {
        mailbox_.put(std::span(&*pose, 1));
    }
    misshapen_ = reader_.counts().misshapen > misshapen;
}

std::string_view TagTracker::state() const {
    const CameraState state = camera_->state();
    return misshapen_ && health_of(state) == CameraHealth::Well
               ? "the camera's frames have another shape than the settings say, so that tags are of no use; "
                 "set camera.width and camera.height to a size that frustumscreen camera lists"
               : sentence_of(state);
}

} // namespace frustumscreen
