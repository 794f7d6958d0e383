#include "assets_baked/bake/loaders/polygon.h"

#include <numeric>

namespace frustumscreen {

namespace {

constexpr std::size_t most_corners_for_ears = 64;

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

class EarCutter {
public:
    EarCutter(std::span<const glm::dvec3> corners, const glm::dvec3& normal)
        : corners_(corners), normal_(normal), left_(corners.size()) {
        std::iota(left_.begin(), left_.end(), 0U);
    }

    void cut(std::vector<std::array<std::uint32_t, 3>>& triangles) {
        while (left_.size() > 3) {
            const std::size_t tip = find_ear();
            triangles.push_back(triangle_at(tip));
            left_.erase(left_.begin() + static_cast<std::ptrdiff_t>(tip));
        }
        triangles.push_back({left_[0], left_[1], left_[2]});
    }

private:
    [[nodiscard]] std::array<std::uint32_t, 3> triangle_at(std::size_t tip) const {
        const std::size_t n = left_.size();
        return {left_[(tip + n - 1) % n], left_[tip], left_[(tip + 1) % n]};
    }
    [[nodiscard]] bool is_ear(std::size_t tip) const {
        const auto [a, b, c] = triangle_at(tip);
        const glm::dvec3 &pa = corners_[a], &pb = corners_[b], &pc = corners_[c];
        if (turn(normal_, pa, pb, pc) <= 0.0) {
            return false;
        }
        for (const std::uint32_t i : left_) {
            const glm::dvec3& p = corners_[i];
            if (i != a && i != b && i != c && turn(normal_, pa, pb, p) >= 0.0 &&
                turn(normal_, pb, pc, p) >= 0.0 && turn(normal_, pc, pa, p) >= 0.0) {
                return false;
            }
        }
        return true;
    }
    /// A polygon that crosses itself may have no ear; then the first corner is cut.
    [[nodiscard]] std::size_t find_ear() const {
        for (std::size_t tip = 0; tip < left_.size(); ++tip) {
            if (is_ear(tip)) {
                return tip;
            }
        }
        return 1;
    }

    std::span<const glm::dvec3> corners_;
    glm::dvec3 normal_;
    std::vector<std::uint32_t> left_;
};

} // namespace

void triangulate_polygon(std::span<const glm::dvec3> corners,
                         std::vector<std::array<std::uint32_t, 3>>& triangles) {
    if (corners.size() > 3 && corners.size() <= most_corners_for_ears) {
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

} // namespace frustumscreen
