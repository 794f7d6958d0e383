/// A triangle over a grid, and the grid's lines that cross it.
///
/// Frames   a direction's grid, texels; rows count from a band's first one.
/// Threads  values; any.
/// Method   64 bits. An edge is evaluated from its lexicographically first end, so two triangles with a common edge evaluate it
///          alike and with opposite signs. A line on an edge belongs to the side of larger v, on an edge along v to the side of
///          smaller u, as if all lines moved by the same small step. So a line crosses a closed surface once, whatever edges and
///          corners it meets.
#pragma once

#include "app/relief/grid_crossings.h"

#include <glm/glm.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <utility>

namespace frustumscreen::ldi {

[[nodiscard]] inline glm::dvec3 applied(const glm::dmat4& affine, const glm::dvec3& point) {
    return glm::dvec3(affine[0]) * point.x + glm::dvec3(affine[1]) * point.y +
           glm::dvec3(affine[2]) * point.z + glm::dvec3(affine[3]);
}

/// Whole numbers within two bounds, and within 0 and `max`; the first one is larger if there are none.
[[nodiscard]] inline std::pair<int, int> whole(double low, double high, int max) {
    const double first = std::max(0.0, std::ceil(low));
    const double last = std::min(static_cast<double>(max), std::floor(high));
    return first <= last ? std::pair(static_cast<int>(first), static_cast<int>(last)) : std::pair(1, 0);
}

class GridTriangle {
public:
    /// nullopt if it has no area across the lines.
    [[nodiscard]] static std::optional<GridTriangle> make(const std::array<glm::dvec3, 3>& corners) {
        GridTriangle made(corners);
        return made.area_ != 0.0 && std::isfinite(made.slope_.x) && std::isfinite(made.slope_.y)
                   ? std::optional(made)
                   : std::nullopt;
    }

    [[nodiscard]] const glm::dvec2& low() const { return low_; }
    [[nodiscard]] const glm::dvec2& high() const { return high_; }

    /// True if the line at (u, v) crosses it.
    [[nodiscard]] bool holds(double u, double v) const {
        return std::all_of(edges_.begin(), edges_.end(), [u, v](const Edge& edge) {
            return (edge.along.x * (v - edge.from.y) - edge.along.y * (u - edge.from.x) >= 0.0) == edge.left;
        });
    }
    [[nodiscard]] relief::LineCrossing crossing(double u, double v) const {
        const double w = corner_.z + slope_.x * (u - corner_.x) + slope_.y * (v - corner_.y);
        return {static_cast<float>(w), static_cast<float>(slope_.x), static_cast<float>(slope_.y)};
    }
    /// Bounds of its u where v is between two values; lowest > highest if it has none.
    [[nodiscard]] std::pair<double, double> columns(double v0, double v1) const {
        if (low_.y >= v0 && high_.y <= v1) {
            return {low_.x, high_.x};
        }
        std::pair<double, double> range(std::numeric_limits<double>::infinity(),
                                        -std::numeric_limits<double>::infinity());
        const auto widen = [&range](double u) {
            range = {std::min(range.first, u), std::max(range.second, u)};
        };
        for (const Edge& edge : edges_) {
            const glm::dvec2 to = edge.from + edge.along;
            for (const glm::dvec2& end : {edge.from, to}) {
                if (end.y >= v0 && end.y <= v1) {
                    widen(end.x);
                }
            }
            for (const double v : {v0, v1}) {
                if ((edge.from.y < v) != (to.y < v)) {
                    widen(edge.from.x + edge.along.x * (v - edge.from.y) / edge.along.y);
                }
            }
        }
        constexpr double rounding = 1e-6; // texels, and of large triangles a share
        const double beside = rounding * (1.0 + std::abs(range.first) + std::abs(range.second));
        return {std::max(low_.x, range.first - beside), std::min(high_.x, range.second + beside)};
    }

private:
    struct Edge {
        glm::dvec2 from, along;
        bool left = false; ///< the triangle lies to the left
    };

    explicit GridTriangle(const std::array<glm::dvec3, 3>& corners)
        : low_(glm::min(glm::dvec2(corners[0]), glm::min(glm::dvec2(corners[1]), glm::dvec2(corners[2])))),
          high_(glm::max(glm::dvec2(corners[0]), glm::max(glm::dvec2(corners[1]), glm::dvec2(corners[2])))),
          corner_(corners[0]) {
        const glm::dvec3 ab = corners[1] - corners[0];
        const glm::dvec3 ac = corners[2] - corners[0];
        area_ = ab.x * ac.y - ab.y * ac.x;
        if (area_ == 0.0) {
            return;
        }
        slope_ = glm::dvec2(ab.z * ac.y - ac.z * ab.y, ac.z * ab.x - ab.z * ac.x) / area_;
        for (std::size_t k = 0; k < 3; ++k) {
            const glm::dvec2 from(corners[k]);
            const glm::dvec2 to(corners[(k + 1) % 3]);
            const bool first = from.x < to.x || (from.x == to.x && from.y < to.y);
            edges_[k] = {first ? from : to, first ? to - from : from - to, (area_ > 0.0) == first};
        }
    }

    std::array<Edge, 3> edges_;
    glm::dvec2 low_, high_;
    glm::dvec3 corner_;
    glm::dvec2 slope_{0.0};
    double area_ = 0.0;
};

} // namespace frustumscreen::ldi
