#include "assets_baked/artifacts/profile.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace frustumscreen::artifacts {
namespace {

constexpr int steps_per_span = 64;
constexpr double bend_mm_per_radian = 12.0; ///< a bend of one radian gets as many rows as this length

/// Barry and Goldman's pyramid for the centripetal Catmull-Rom spline.
glm::dvec2 catmull_rom(const std::array<glm::dvec2, 4>& p, double fraction) {
    std::array<double, 4> t{};
    for (std::size_t i = 1; i < 4; ++i) {
        t[i] = t[i - 1] + std::max(1e-6, std::sqrt(glm::length(p[i] - p[i - 1])));
    }
    const double x = glm::mix(t[1], t[2], fraction);
    const auto blend = [&](const glm::dvec2& a, const glm::dvec2& b, std::size_t i, std::size_t j) {
        return a + (b - a) * ((x - t[i]) / (t[j] - t[i]));
    };
    const glm::dvec2 a = blend(p[0], p[1], 0, 1);
    const glm::dvec2 b = blend(p[1], p[2], 1, 2);
    const glm::dvec2 c = blend(p[2], p[3], 2, 3);
    return blend(blend(a, b, 0, 2), blend(b, c, 1, 3), 1, 2);
}

std::vector<glm::dvec2> sample(const std::vector<ProfileKnot>& knots) {
    const auto position = [&](std::size_t i) { return glm::dvec2(knots[i].radius, knots[i].height); };
    std::vector<glm::dvec2> points = {position(0)};
    for (std::size_t i = 0; i + 1 < knots.size(); ++i) {
        const glm::dvec2 a = position(i);
        const glm::dvec2 b = position(i + 1);
        const bool free_start = i == 0 || knots[i].corner;
        const bool free_end = i + 2 == knots.size() || knots[i + 1].corner;
        const glm::dvec2 before = free_start ? 2.0 * a - b : position(i - 1);
        const glm::dvec2 after = free_end ? 2.0 * b - a : position(i + 2);
        for (int step = 1; step <= steps_per_span; ++step) {
            points.push_back(catmull_rom({before, a, b, after}, static_cast<double>(step) / steps_per_span));
        }
    }
    return points;
}

} // namespace

Profile::Profile(const std::vector<ProfileKnot>& knots) {
    const std::vector<glm::dvec2> samples = sample(knots);
    double length = 0.0;
    double row = 0.0;
    glm::dvec2 last_direction{0.0};
    for (std::size_t i = 0; i < samples.size(); ++i) {
        const glm::dvec2 step = samples[std::min(i + 1, samples.size() - 1)] - samples[i > 0 ? i - 1 : 0];
        const glm::dvec2 direction = glm::normalize(step);
        if (i > 0) {
            const double travelled = glm::distance(samples[i], samples[i - 1]);
            length += travelled;
            row += travelled +
                   bend_mm_per_radian * std::acos(std::clamp(glm::dot(direction, last_direction), -1.0, 1.0));
        }
        last_direction = direction;
        points_.push_back({samples[i], {direction.y, -direction.x}, length});
        rows_.push_back(row);
    }
    for (double& value : rows_) {
        value /= row;
    }
}

Profile::Point Profile::between(std::size_t index, double fraction) const {
    const Point& a = points_[index];
    const Point& b = points_[index + 1];
    return {glm::mix(a.position, b.position, fraction),
            glm::normalize(glm::mix(a.normal, b.normal, fraction)),
            glm::mix(a.length_mm, b.length_mm, fraction)};
}

Profile::Point Profile::at_length(double length_mm) const {
    const auto above = std::upper_bound(points_.begin() + 1, points_.end() - 1, length_mm,
                                        [](double value, const Point& p) { return value < p.length_mm; });
    const auto index = static_cast<std::size_t>(above - points_.begin()) - 1;
    const double span = points_[index + 1].length_mm - points_[index].length_mm;
    return between(index, std::clamp((length_mm - points_[index].length_mm) / span, 0.0, 1.0));
}

Profile::Point Profile::at_row(double row) const {
    const auto above = std::upper_bound(rows_.begin() + 1, rows_.end() - 1, row);
    const auto index = static_cast<std::size_t>(above - rows_.begin()) - 1;
    return between(index, std::clamp((row - rows_[index]) / (rows_[index + 1] - rows_[index]), 0.0, 1.0));
}

double Profile::length_at_height(double height) const {
    for (std::size_t i = 0; i + 1 < points_.size(); ++i) {
        const double a = points_[i].position.y;
        const double b = points_[i + 1].position.y;
        if (a <= height && height <= b && a < b) {
            return glm::mix(points_[i].length_mm, points_[i + 1].length_mm, (height - a) / (b - a));
        }
    }
    return height < points_.front().position.y ? 0.0 : length_mm();
}

} // namespace frustumscreen::artifacts
