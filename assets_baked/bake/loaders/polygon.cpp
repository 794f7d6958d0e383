#include "assets_baked/bake/loaders/polygon.h"

#include <algorithm>

namespace frustumscreen::bake {

namespace {

/// Newell's normal: correct for any planar polygon, concave ones too.
glm::dvec3 normal_of(std::span<const glm::dvec3> corners) {
    glm::dvec3 normal(0.0);
    for (std::size_t i = 0; i < corners.size(); ++i) {
        normal += glm::cross(corners[i] - corners[0], corners[(i + 1) % corners.size()] - corners[0]);
    }
    return normal;
}

/// Twice the signed area of a, b, c as seen against `normal`.
double turn(const glm::dvec3& normal, const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
    return glm::dot(normal, glm::cross(b - a, c - a));
}

bool is_convex(std::span<const glm::dvec3> corners, const glm::dvec3& normal) {
    const std::size_t n = corners.size();
    for (std::size_t i = 0; i < n; ++i) {
        if (turn(normal, corners[i], corners[(i + 1) % n], corners[(i + 2) % n]) < 0.0) {
            return false;
        }
    }
    return true;
}

/// Cuts ears off a polygon; the remaining corners form a ring.
class EarCutter {
public:
    EarCutter(std::span<const glm::dvec3> corners, const glm::dvec3& normal)
        : corners_(corners), normal_(normal), next_(corners.size()), previous_(corners.size()),
          is_reflex_(corners.size(), false) {
        const auto count = static_cast<std::uint32_t>(corners.size());
        for (std::uint32_t i = 0; i < count; ++i) {
            next_[i] = (i + 1) % count;
            previous_[i] = (i + count - 1) % count;
        }
        for (std::uint32_t i = 0; i < count; ++i) {
            is_reflex_[i] = turn_at(i) <= 0.0;
            if (is_reflex_[i]) {
                reflex_.push_back(i);
            }
        }
    }

    void cut(std::vector<std::array<std::uint32_t, 3>>& triangles) {
        std::uint32_t tip = 0;
        std::size_t tried = 0;
        for (std::size_t left = corners_.size(); left > 3;) {
            // A polygon that crosses itself may have no ear; then any corner is cut.
            if (tried < left && !is_ear(tip)) {
                tip = next_[tip];
                ++tried;
                continue;
            }
            triangles.push_back({previous_[tip], tip, next_[tip]});
            tip = cut_off(tip);
            --left;
            tried = 0;
        }
        triangles.push_back({previous_[tip], tip, next_[tip]});
    }

private:
    [[nodiscard]] double turn_at(std::uint32_t tip) const {
        return turn(normal_, corners_[previous_[tip]], corners_[tip], corners_[next_[tip]]);
    }

    /// Returns the next corner to test: the second one after the tip, so that no corner collects a fan of triangles.
    std::uint32_t cut_off(std::uint32_t tip) {
        const std::uint32_t before = previous_[tip];
        const std::uint32_t after = next_[tip];
        next_[before] = after;
        previous_[after] = before;
        is_reflex_[tip] = false;
        for (const std::uint32_t corner : {before, after}) { // a convex corner stays convex
            is_reflex_[corner] = is_reflex_[corner] && turn_at(corner) <= 0.0;
        }
        std::erase_if(reflex_, [&](std::uint32_t i) { return !is_reflex_[i]; });
        return next_[after];
    }

    [[nodiscard]] bool is_ear(std::uint32_t tip) const {
        const glm::dvec3& a = corners_[previous_[tip]];
        const glm::dvec3& b = corners_[tip];
        const glm::dvec3& c = corners_[next_[tip]];
        if (turn(normal_, a, b, c) <= 0.0) {
            return false;
        }
        // A corner at the position of one of the three is a point where the outline touches itself.
        return std::none_of(reflex_.begin(), reflex_.end(), [&](std::uint32_t i) {
            const glm::dvec3& p = corners_[i];
            return p != a && p != b && p != c && turn(normal_, a, b, p) >= 0.0 &&
                   turn(normal_, b, c, p) >= 0.0 && turn(normal_, c, a, p) >= 0.0;
        });
    }

    std::span<const glm::dvec3> corners_;
    glm::dvec3 normal_;
    std::vector<std::uint32_t> next_;
    std::vector<std::uint32_t> previous_;
    std::vector<bool> is_reflex_;
    std::vector<std::uint32_t> reflex_; ///< remaining corners that are not convex
};

} // namespace

void triangulate_polygon(std::span<const glm::dvec3> corners,
                         std::vector<std::array<std::uint32_t, 3>>& triangles) {
    if (corners.size() > 3) {
        const glm::dvec3 normal = normal_of(corners);
        if (!is_convex(corners, normal)) {
            EarCutter(corners, normal).cut(triangles);
            return;
        }
    }
    for (std::uint32_t i = 2; i < corners.size(); ++i) {
        triangles.push_back({0U, i - 1, i});
    }
}

} // namespace frustumscreen::bake
