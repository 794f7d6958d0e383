/// Moves the prop with a mouse: dragging slides it about, the wheel turns it.
///
/// Frame    table T, metres, radians; the prop stands upright on the table.
/// Threads  values.
#pragma once

#include "firmware_host/tracker/tracker.h"

#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>

#include <algorithm>
#include <optional>

namespace frustumscreen {

class MouseHand {
public:
    /// The prop's centre stays within `half_extent_m` of the table's.
    explicit MouseHand(const glm::dvec2& half_extent_m) : half_extent_m_(half_extent_m) {}

    /// Takes hold at the mouse's place on the table; the prop does not jump there.
    void take(const glm::dvec2& at_m) { grip_m_ = centre_m_ - at_m; }
    void let_go() { grip_m_.reset(); }
    void move(const glm::dvec2& at_m) {
        if (grip_m_) {
            centre_m_ = glm::clamp(at_m + *grip_m_, -half_extent_m_, half_extent_m_);
        }
    }
    void turn(double angle) { angle_ += angle; }

    [[nodiscard]] PoseSample prop(MonotonicTime now) const {
        return {now, prop_station, glm::dvec3(centre_m_, 0.0),
                glm::angleAxis(angle_, glm::dvec3(0.0, 0.0, 1.0)), true};
    }

private:
    glm::dvec2 half_extent_m_;
    glm::dvec2 centre_m_{0.0};
    double angle_ = 0.0;
    std::optional<glm::dvec2> grip_m_; ///< from the mouse to the prop's centre, while it is held
};

} // namespace frustumscreen
