#include "app/exhibit/idle_pose.h"

#include <cmath>
#include <numbers>

namespace frustumscreen::exhibit {

namespace {

enum Shown : std::size_t { Prop, Turning };

} // namespace

IdlePose::IdlePose(const glm::dvec2& place_m, bool known, MonotonicTime now, bool in_hand)
    : place_m_(place_m), fade_(known ? Prop : Turning, each_way, now - each_way), turns_since_(now) {
    if (in_hand) {
        hand_fade_.emplace();
    }
}

bool IdlePose::lost() const {
    return fade_.goal() == Turning;
}

DrawnPose IdlePose::at(MonotonicTime now, bool known, Nanoseconds age,
                       const geometry::RigidTransform& table_from_prop) {
    const bool never = !known && age == Nanoseconds::zero();
    if (known && fade_.goal() == Turning) {
        fade_.turn_to(Prop, now);
    } else if (!known && (never || age >= held) && fade_.goal() == Prop) {
        // The fade begins as if a frame had come at exactly that time, but not before a running fade has ended.
        const MonotonicTime due = never ? now : now - (age - held);
        turns_since_ = fade_.at(now).which == Prop ? due : turns_since_;
        fade_.turn_to(Turning, due);
    }
    const Faded faded = fade_.at(now);
    const double in_hand = hand_fade_ ? hand_fade_->at(now, age) : 1.0;
    if (faded.which == Prop) {
        return {.table_from_prop = table_from_prop,
                .brightness = faded.brightness * in_hand,
                .changing = faded.changing || (in_hand > 0.0 && in_hand < 1.0),
                .attracts = false};
    }
    const double turns = to_seconds(now - turns_since_) / to_seconds(turn);
    const glm::dquat rotation =
        glm::angleAxis(2.0 * std::numbers::pi * (turns - std::floor(turns)), glm::dvec3(0.0, 0.0, 1.0));
    return {.table_from_prop = {rotation, glm::dvec3(place_m_, 0.0)},
            .brightness = faded.brightness,
            .changing = faded.changing,
            .attracts = true};
}

std::optional<typography::TablePolygon> area_hidden_by(const geometry::PropShape& prop,
                                                       const DrawnPose& drawn, const glm::dvec3& from_m) {
    std::optional<typography::TablePolygon> hidden =
        typography::hidden_by_prop(prop, drawn.table_from_prop, from_m);
    if (!hidden || !drawn.attracts) {
        return hidden;
    }
    constexpr double eighth = 0.25 * std::numbers::pi;
    typography::TablePolygon all;
    for (const double yaw : {0.0, eighth}) {
        const geometry::RigidTransform pose{glm::angleAxis(yaw, glm::dvec3(0.0, 0.0, 1.0)),
                                            drawn.table_from_prop.translation};
        if (const std::optional<typography::TablePolygon> one =
                typography::hidden_by_prop(prop, pose, from_m)) {
            all = typography::hull_of(all, one->corners());
        }
    }
    return all;
}

} // namespace frustumscreen::exhibit
