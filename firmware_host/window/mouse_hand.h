/// Moves the prop and the visitor's eye with a mouse: one drag slides the prop, the wheel turns it, another
/// drag moves the eye around the table.
///
/// Frame    table T, metres, radians; the prop stands upright on the table.
/// Threads  values.
#pragma once

#include "firmware_host/tracker/tracker.h"

#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>

#include <algorithm>
#include <cmath>
#include <optional>

namespace frustumscreen::window {

class MouseHand {
public:
    /// The prop's centre stays within `half_extent_m` of the table's centre. The eye begins at `eye_m` and
    /// keeps its distance from the table's centre.
    explicit MouseHand(const glm::dvec2& half_extent_m, const glm::dvec3& eye_m = {0.0, -0.55, 0.5})
        : half_extent_m_(half_extent_m), eye_distance_m_(glm::length(eye_m)),
          eye_azimuth_(std::atan2(eye_m.y, eye_m.x)), eye_elevation_(std::asin(eye_m.z / eye_distance_m_)) {}

    /// Grips the prop at the mouse's place on the table; the prop does not jump there.
    void take(const glm::dvec2& at_m) { grip_m_ = centre_m_ - at_m; }
    void let_go() { grip_m_.reset(); }
    void move(const glm::dvec2& at_m) {
        if (grip_m_) {
            centre_m_ = glm::clamp(at_m + *grip_m_, -half_extent_m_, half_extent_m_);
        }
    }
    void turn(double angle) { angle_ += angle; }
    /// Moves the eye around the table and up; it stays between 5 and 85 degrees above the table.
    void look(double around, double up) {
        eye_azimuth_ += around;
        eye_elevation_ = std::clamp(eye_elevation_ + up, lowest_, highest_);
    }

    [[nodiscard]] tracker::PoseSample prop(MonotonicTime now) const {
        return {.time = now,
                .station = tracker::prop_station,
                .position_m = glm::dvec3(centre_m_, 0.0),
                .rotation = glm::angleAxis(angle_, glm::dvec3(0.0, 0.0, 1.0)),
                .ok = true};
    }
    /// The head is level and looks at the prop.
    [[nodiscard]] tracker::PoseSample head(MonotonicTime now) const {
        const glm::dvec3 direction(std::cos(eye_azimuth_) * std::cos(eye_elevation_),
                                   std::sin(eye_azimuth_) * std::cos(eye_elevation_),
                                   std::sin(eye_elevation_));
        const glm::dvec3 eye_m = eye_distance_m_ * direction;
        const double turn = std::atan2(eye_m.x - centre_m_.x, centre_m_.y - eye_m.y);
        return {.time = now,
                .station = tracker::head_station,
                .position_m = eye_m,
                .rotation = glm::angleAxis(turn, glm::dvec3(0.0, 0.0, 1.0)),
                .ok = true};
    }

private:
    static constexpr double lowest_ = 0.0873;
    static constexpr double highest_ = 1.4835;

    glm::dvec2 half_extent_m_;
    glm::dvec2 centre_m_{0.0};
    double angle_ = 0.0;
    std::optional<glm::dvec2> grip_m_; ///< from the mouse to the prop's centre, while it is held
    double eye_distance_m_;
    double eye_azimuth_;
    double eye_elevation_;
};

} // namespace frustumscreen::window
