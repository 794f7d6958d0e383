#include "app/guidance/move.h"

#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace frustumscreen::guidance {

namespace {

constexpr glm::dvec3 up(0.0, 0.0, 1.0);

glm::dquat about_vertical(double angle_rad) {
    return glm::angleAxis(angle_rad, up);
}

/// Turns the prop about a point of its own, given in the prop's frame.
geometry::RigidTransform turned(const geometry::RigidTransform& table_from_prop, const glm::dquat& turn,
                                const glm::dvec3& fixed) {
    const glm::dvec3 place = table_from_prop.point(fixed);
    const glm::dquat rotation = turn * table_from_prop.rotation;
    return {rotation, place - rotation * fixed};
}

/// The shortest turn that brings the prop's axis to the vertical.
glm::dquat to_upright(const geometry::RigidTransform& table_from_prop) {
    const glm::dvec3 axis = table_from_prop.direction(up);
    const glm::dvec3 across = glm::cross(axis, up);
    const double sine = glm::length(across);
    if (sine < 1e-9) {
        return axis.z > 0.0 ? glm::dquat(1, 0, 0, 0)
                            : glm::angleAxis(std::numbers::pi, table_from_prop.direction({1.0, 0.0, 0.0}));
    }
    return glm::angleAxis(std::atan2(sine, axis.z), across / sine);
}

glm::dvec3 way_of(const Move& move, const Execution& execution) {
    const glm::dvec3 way = about_vertical(execution.aside_rad) * (move.by_m * execution.amount);
    if (execution.raised_rad == 0.0) {
        return way;
    }
    const glm::dvec2 level(way);
    const double length = glm::length(level);
    // A vertical way has no azimuth of its own: it leans over to the side that `aside_rad` gives.
    const glm::dvec2 ahead = length > 1e-9
                                 ? level / length
                                 : glm::dvec2(std::cos(execution.aside_rad), std::sin(execution.aside_rad));
    const double across = glm::dot(glm::dvec2(way), ahead);
    const double cosine = std::cos(execution.raised_rad);
    const double sine = std::sin(execution.raised_rad);
    return {ahead * (across * cosine - way.z * sine), across * sine + way.z * cosine};
}

/// A hand cannot push the prop into the table.
void keep_above_table(const geometry::PropShape& prop, geometry::RigidTransform& table_from_prop) {
    table_from_prop.translation.z += std::fmax(0.0, -lowest_m(prop, table_from_prop));
}

geometry::RigidTransform standing(const Move& move, const GuidanceSetup& setup,
                                  const geometry::RigidTransform& table_from_prop,
                                  const Execution& execution) {
    const glm::dquat turn = about_vertical(execution.aside_rad) * to_upright(table_from_prop);
    if (setup.in_hand) {
        geometry::RigidTransform held =
            turned(table_from_prop, turn, execution.about_origin ? glm::dvec3(0.0) : setup.prop.middle);
        held.translation += way_of(move, execution);
        return held;
    }
    // An arm that moves sideways turns the prop with it.
    const glm::dvec2 place(table_from_prop.translation + way_of(move, execution));
    return {turn * table_from_prop.rotation, {place, 0.0}};
}

} // namespace

std::string_view name_of(Action action) {
    constexpr std::array<std::string_view, 8> names{"slide",      "turn",  "set_down", "upright",
                                                    "come_round", "raise", "lower",    "wait"};
    return names.at(static_cast<std::size_t>(action));
}

std::string_view name_of(Side side) {
    constexpr std::array<std::string_view, 4> names{"front", "right", "back", "left"};
    return names.at(static_cast<std::size_t>(side));
}

bool alike(const Move& a, const Move& b) {
    if (a.action != b.action) {
        return false;
    }
    switch (a.action) {
    case Action::Slide:
        // Directions up to 30 degrees apart.
        return glm::dot(a.by_m, b.by_m) >= 0.86 * glm::length(a.by_m) * glm::length(b.by_m);
    case Action::Turn:
        return (a.turn_rad > 0.0) == (b.turn_rad > 0.0);
    case Action::ComeRound:
        return a.side == b.side;
    case Action::SetDown:
    case Action::Upright: {
        constexpr double elsewhere_m = 0.10;
        return glm::distance(a.by_m, b.by_m) <=
               std::fmax(elsewhere_m, 0.5 * std::fmax(glm::length(a.by_m), glm::length(b.by_m)));
    }
    default:
        return true;
    }
}

GuidedState after(const Move& move, const GuidanceSetup& setup, const GuidedState& before,
                  const Execution& execution) {
    GuidedState tracked_state = before;
    geometry::RigidTransform& pose = tracked_state.table_from_prop;
    switch (move.action) {
    case Action::Slide:
    case Action::Raise:
    case Action::Lower:
        pose.translation += way_of(move, execution);
        if (setup.in_hand) {
            keep_above_table(setup.prop, pose);
        }
        break;
    case Action::Turn:
        pose = turned(pose, about_vertical(move.turn_rad * execution.amount),
                      execution.about_origin ? glm::dvec3(0.0) : setup.prop.middle);
        break;
    case Action::SetDown:
    case Action::Upright:
        pose = standing(move, setup, pose, execution);
        break;
    case Action::ComeRound: {
        const double azimuth =
            0.5 * std::numbers::pi * (static_cast<double>(move.side) - 1.0) + execution.aside_rad;
        const double radius = glm::length(glm::dvec2(before.eye_m)) * std::sqrt(execution.amount);
        tracked_state.eye_m = {radius * std::cos(azimuth), radius * std::sin(azimuth), before.eye_m.z};
        if (before.has_two_eyes()) { // the head turns with the way
            const double round_rad = azimuth - std::atan2(before.eye_m.y, before.eye_m.x);
            tracked_state.to_right_eye_m = about_vertical(round_rad) * before.to_right_eye_m;
        }
        break;
    }
    case Action::Wait:
        break;
    }
    return tracked_state;
}

double tilt_rad(const geometry::RigidTransform& table_from_prop) {
    const glm::dvec3 axis = table_from_prop.direction(up);
    return std::atan2(std::hypot(axis.x, axis.y), axis.z);
}

double lowest_m(const geometry::PropShape& prop, const geometry::RigidTransform& table_from_prop) {
    double lowest = std::numeric_limits<double>::infinity();
    for (const glm::dvec3& corner : prop.corners) {
        lowest = std::fmin(lowest, table_from_prop.point(corner).z);
    }
    return lowest;
}

bool over_table(const GuidanceSetup& setup, const geometry::RigidTransform& table_from_prop) {
    const glm::dvec2 place(table_from_prop.translation);
    return std::abs(place.x) <= setup.half_table_m.x && std::abs(place.y) <= setup.half_table_m.y;
}

} // namespace frustumscreen::guidance
