#include "app/calibration/tag_pixels.h"

#include "app/calibration/homography.h"
#include "app/calibration/quadrilateral.h"

#include <algorithm>
#include <cmath>

namespace frustumscreen::calibration {

namespace {

/// The white rim around a tag lies in its plane; the surroundings may not.
constexpr double reach = 1.15;
/// Share of the contrast on the tag's white.
constexpr double min_white = 0.75;
constexpr std::size_t min_pixels = 60;
/// A decoded pixel whose residual is more than this multiple of the median is wrong.
constexpr double farthest = 4.0;

using Points = std::vector<Eigen::Vector2d>;

/// Decoded pixels on white inside a quadrilateral: the camera's, and the projector's. Pixels on black, and on
/// its edge, are dominated by light from the white beside them.
std::pair<Points, Points> decoded_in(const PixelMap& map, const std::array<glm::dvec2, 4>& corners) {
    std::vector<std::pair<glm::dvec2, std::size_t>> inside;
    std::vector<std::uint8_t> contrasts;
    for_each_pixel(corners, map.width, map.height, [&](std::size_t k, const glm::dvec2& place) {
        if (map.known[k] != 0) {
            inside.emplace_back(place, k);
            contrasts.push_back(map.contrast[k]);
        }
    });
    std::sort(contrasts.begin(), contrasts.end());
    const double white = contrasts.empty() ? 0.0 : contrasts[contrasts.size() * 9 / 10];
    std::pair<Points, Points> points;
    for (const auto& [place, k] : inside) {
        if (map.contrast[k] > min_white * white) {
            points.first.emplace_back(place.x, place.y);
            points.second.emplace_back(map.pixels[k].x, map.pixels[k].y);
        }
    }
    return points;
}

/// The points whose residual against the homography is within a few medians.
std::pair<Points, Points> believed(const std::pair<Points, Points>& points, const Eigen::Matrix3d& map) {
    std::vector<double> off;
    for (std::size_t k = 0; k < points.first.size(); ++k) {
        off.push_back((mapped(map, points.first[k]) - points.second[k]).norm());
    }
    std::vector<double> sorted = off;
    const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
    std::nth_element(sorted.begin(), middle, sorted.end());
    std::pair<Points, Points> kept;
    for (std::size_t k = 0; k < off.size(); ++k) {
        if (off[k] <= farthest * *middle) {
            kept.first.push_back(points.first[k]);
            kept.second.push_back(points.second[k]);
        }
    }
    return kept;
}

} // namespace

std::optional<std::array<glm::dvec2, 4>> tag_pixels(const PixelMap& map,
                                                    const std::array<glm::dvec2, 4>& corners) {
    const glm::dvec2 middle = 0.25 * (corners[0] + corners[1] + corners[2] + corners[3]);
    std::array<glm::dvec2, 4> around = corners;
    for (glm::dvec2& corner : around) {
        corner = middle + reach * (corner - middle);
    }
    std::pair<Points, Points> points = decoded_in(map, around);
    std::optional<Eigen::Matrix3d> pixel_from_camera;
    for (int round = 0; round < 3; ++round) {
        if (points.first.size() < min_pixels) {
            return std::nullopt;
        }
        pixel_from_camera = homography(points.first, points.second);
        if (!pixel_from_camera) {
            return std::nullopt;
        }
        points = believed(points, *pixel_from_camera);
    }
    std::array<glm::dvec2, 4> pixels{};
    for (std::size_t k = 0; k < 4; ++k) {
        const Eigen::Vector2d pixel = mapped(*pixel_from_camera, {corners[k].x, corners[k].y});
        pixels[k] = {pixel.x(), pixel.y()};
    }
    return pixels;
}

} // namespace frustumscreen::calibration
