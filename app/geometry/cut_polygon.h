/// A convex polygon that planes cut, in memory of its own.
///
/// Frames   any, also homogeneous places.
/// Threads  values; any.
#pragma once

#include <glm/glm.hpp>

#include <array>
#include <cstddef>
#include <span>

namespace frustumscreen::geometry {

/// Up to `n` corners; each cut adds one at most.
template <std::size_t n> class CutPolygon {
public:
    explicit CutPolygon(const std::array<glm::dvec3, 3>& triangle) : count_(3) {
        for (std::size_t k = 0; k < 3; ++k) {
            places_[k] = triangle[k];
        }
    }
    [[nodiscard]] std::span<const glm::dvec3> corners() const { return std::span(places_).first(count_); }

    /// Leaves the part where `side_of(place)`, which is linear, is not negative. The common edge of two triangles is cut in the
    /// same place. `n` - 3 cuts at most.
    template <typename Side> void cut(const Side& side_of) {
        const std::array<glm::dvec3, n> before = places_;
        const std::size_t count = count_;
        count_ = 0;
        double to_side = count > 0 ? side_of(before[0]) : 0.0;
        for (std::size_t k = 0; k < count; ++k) {
            const glm::dvec3& from = before[k];
            const glm::dvec3& to = before[(k + 1) % count];
            const double from_side = to_side;
            to_side = side_of(to);
            if (from_side >= 0.0) {
                places_[count_++] = from;
            }
            if (from_side >= 0.0 && to_side < 0.0) {
                places_[count_++] = between(from, to, from_side, to_side);
            } else if (from_side < 0.0 && to_side >= 0.0) { // from the inside too
                places_[count_++] = between(to, from, to_side, from_side);
            }
        }
    }

private:
    static glm::dvec3 between(const glm::dvec3& inside, const glm::dvec3& outside, double inside_by,
                              double outside_by) {
        return inside + inside_by / (inside_by - outside_by) * (outside - inside);
    }

    std::array<glm::dvec3, n> places_{};
    std::size_t count_ = 0;
};

} // namespace frustumscreen::geometry
