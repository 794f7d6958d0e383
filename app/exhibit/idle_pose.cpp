#include "app/exhibit/idle_pose.h"

#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace frustumscreen::exhibit {

namespace {

enum Shown : std::size_t { Prop, Turning };

/// A square foot and the same foot turned by 45 degrees make an octagon. At any other yaw the foot exceeds the octagon by
/// at most 8 per cent of its radius; captions keep a larger distance.
typography::TablePolygon hidden_at_two_turns(const geometry::PropShape& prop, const glm::dvec3& place_m,
                                             const glm::dvec3& from_m) {
    constexpr double eighth = 0.25 * std::numbers::pi;
    typography::TablePolygon all;
    for (const double yaw : {0.0, eighth}) {
        const geometry::RigidTransform pose{glm::angleAxis(yaw, glm::dvec3(0.0, 0.0, 1.0)), place_m};
        if (const std::optional<typography::TablePolygon> one =
                typography::hidden_by_prop(prop, pose, from_m)) {
            all = typography::hull_of(all, one->corners());
        }
    }
    return all;
}

/// Each corner describes a circle about the vertical axis, and the circle's shadow on the table is a circle too. In each
/// of `sides` directions the polygon touches the farthest of these shadows; it exceeds them by at most 1 per cent.
typography::TablePolygon hidden_at_all_turns(const geometry::PropShape& prop, const glm::dvec3& place_m,
                                             const glm::dvec3& from_m) {
    constexpr std::size_t sides = 24;
    constexpr double step = 2.0 * std::numbers::pi / sides;
    const auto outward = [](std::size_t k) {
        const double azimuth = step * static_cast<double>(k);
        return glm::dvec2(std::cos(azimuth), std::sin(azimuth));
    };
    const auto reach = [&](const glm::dvec2& direction) {
        double farthest = -std::numeric_limits<double>::infinity();
        for (const glm::dvec3& corner : prop.corners) {
            const double larger = from_m.z / (from_m.z - std::fmax(corner.z, 0.0));
            const glm::dvec2 middle = glm::mix(glm::dvec2(from_m), glm::dvec2(place_m), larger);
            farthest =
                std::fmax(farthest, glm::dot(middle, direction) + larger * glm::length(glm::dvec2(corner)));
        }
        return farthest;
    };
    std::array<glm::dvec2, sides> corners{};
    for (std::size_t k = 0; k < sides; ++k) {
        const glm::dvec2 a = outward(k);
        const glm::dvec2 b = outward(k + 1);
        const double to_a = reach(a);
        const double to_b = reach(b);
        corners[k] = glm::dvec2(to_a * b.y - to_b * a.y, to_b * a.x - to_a * b.x) / std::sin(step);
    }
    return typography::hull_of({}, corners);
}

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
    const glm::dvec3& place_m = drawn.table_from_prop.translation;
    return geometry::quarters_to_same(prop) == 1 ? hidden_at_two_turns(prop, place_m, from_m)
                                                 : hidden_at_all_turns(prop, place_m, from_m);
}

} // namespace frustumscreen::exhibit
