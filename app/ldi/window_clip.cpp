#include "app/ldi/window_clip.h"

#include <algorithm>
#include <cassert>
#include <limits>

namespace frustumscreen::ldi {

namespace {

/// A component along the outward axis of a side: x, -x, y, -y.
double outward(const glm::dvec3& point, std::size_t side) {
    const double along = side < 2 ? point.x : point.y;
    return side % 2 == 0 ? along : -along;
}

} // namespace

WindowClip::WindowClip(std::span<const glm::dvec3> eyes, const glm::dvec2& half_extent_m)
    : half_(half_extent_m) {
    assert(!eyes.empty());
    behind_.fill(std::numeric_limits<double>::infinity());
    before_.fill(-std::numeric_limits<double>::infinity());
    for (const glm::dvec3& eye : eyes) {
        assert(eye.z > 0.0);
        max_z_ = std::max(max_z_, eye.z);
        for (std::size_t side = 0; side < 4; ++side) {
            const double slope = (outward(eye, side) - half_[static_cast<int>(side / 2)]) / eye.z;
            behind_[side] = std::min(behind_[side], slope);
            before_[side] = std::max(before_[side], slope);
        }
    }
}

unsigned WindowClip::beyond(const glm::dvec3& point, double margin_m) const {
    unsigned sides = point.z < max_z_ ? 0U : 16U;
    for (std::size_t side = 0; side < 4; ++side) {
        sides |= outward(point, side) > reach(side, point.z) + margin_m ? 1U << side : 0U;
    }
    return sides;
}

glm::dvec4 WindowClip::rectangle(double z) const {
    return {-reach(1, z), -reach(3, z), reach(0, z), reach(2, z)};
}

} // namespace frustumscreen::ldi
