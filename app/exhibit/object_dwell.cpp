#include "app/exhibit/object_dwell.h"

namespace frustumscreen::exhibit {

std::optional<RoomObject> ObjectDwell::step(MonotonicTime now, const Input& input) {
    const std::optional<RoomObject>& object = input.object;
    if (done_ && (!object || object->object != *done_)) {
        done_.reset();
    }
    if (object && input.other_press) {
        done_ = object->object;
    }
    const bool goes_on = rest_ && object == rest_->object && now - last_ < longest_gap &&
                         glm::distance(input.prop_m, rest_->anchor_m) < resting_m;
    if (!goes_on) {
        rest_.reset();
    }
    last_ = now;
    settled_.reset();
    if (!object || object->artifact == input.in_prop || done_) {
        rest_.reset();
        return std::nullopt;
    }
    if (!rest_) {
        rest_ = Rest{*object, now, input.prop_m};
    }
    if (now - rest_->since < settles) {
        return std::nullopt;
    }
    settled_ = *object;
    if (!input.choose && now - rest_->since < lasts) {
        return std::nullopt;
    }
    done_ = object->object;
    rest_.reset();
    return settled_;
}

} // namespace frustumscreen::exhibit
