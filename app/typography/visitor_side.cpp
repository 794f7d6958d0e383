#include "app/typography/visitor_side.h"

#include <cmath>
#include <numbers>

namespace frustumscreen::typography {

namespace {

constexpr double quarter_deg = 90.0;

double degrees(double radians) {
    return radians * 180.0 / std::numbers::pi;
}

} // namespace

glm::dvec2 turned(const glm::dvec2& point, int quarter_turns) {
    switch (((quarter_turns % 4) + 4) % 4) {
    case 1:
        return {-point.y, point.x};
    case 2:
        return -point;
    case 3:
        return {point.y, -point.x};
    default:
        return point;
    }
}

int VisitorSide::update(const glm::dvec3& eye_m) {
    if (!(std::hypot(eye_m.x, eye_m.y) >= leaning_m)) {
        return quarter_turns_;
    }
    const double from_front = degrees(std::atan2(eye_m.y, eye_m.x)) + quarter_deg; // 0 at -Y
    const double off = std::remainder(from_front - quarter_deg * quarter_turns_, 4.0 * quarter_deg);
    const double margin = known_ ? hysteresis_deg : 0.0;
    known_ = true;
    if (std::abs(off) > 0.5 * quarter_deg + margin) {
        const int quarters = static_cast<int>(std::lround(from_front / quarter_deg));
        quarter_turns_ = ((quarters % 4) + 4) % 4;
    }
    return quarter_turns_;
}

} // namespace frustumscreen::typography
