/// The part of space that some eye of a patch sees through its window.
///
/// Frames   window (triangle_world.h). Units: metres.
/// Threads  immutable; any.
/// Method   a point at height z is seen from an eye beside it through the window's side at h if it lies below h + z k, where
///          k = (eye - h) / eye.z is the slope of the line from the eye over that side. The least k of a patch's eyes counts
///          behind the window and the largest one before it, so the part that is not seen across a side is convex: a
///          triangle whose corners all lie in it is not seen.
#pragma once

#include <glm/glm.hpp>

#include <array>
#include <span>

namespace frustumscreen::ldi {

class WindowClip {
public:
    /// `eyes`: with z > 0, at least one.
    WindowClip(std::span<const glm::dvec3> eyes, const glm::dvec2& half_extent_m);

    /// Bit k: beyond side k by more than `margin_m`: right, left, top, bottom; bit 4: not before any eye.
    [[nodiscard]] unsigned beyond(const glm::dvec3& point, double margin_m) const;
    /// Lowest and highest x and y that are seen at a height: x, y, x, y.
    [[nodiscard]] glm::dvec4 rectangle(double z) const;
    [[nodiscard]] double max_z() const { return max_z_; }

private:
    [[nodiscard]] double reach(std::size_t side, double z) const {
        return half_[static_cast<int>(side / 2)] + z * (z < 0.0 ? behind_[side] : before_[side]);
    }

    glm::dvec2 half_;
    std::array<double, 4> behind_{}, before_{}; ///< slopes: right, left, top, bottom
    double max_z_ = 0.0;
};

} // namespace frustumscreen::ldi
