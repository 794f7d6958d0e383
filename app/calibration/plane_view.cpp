#include "app/calibration/plane_view.h"

#include "app/calibration/homography.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace frustumscreen::calibration {

namespace {

constexpr double same_level_m = 1e-3;
/// A homography does not model a lens's distortion over the sheet: some pixels are allowed.
constexpr double min_limit_px = 4.0;
constexpr double max_limit_px = 12.0;
/// With three of ten points wrong, a quarter of the samples are right; the chance that none of them is, is
/// 1e-14.
constexpr int sample_count = 120;

using Points = std::vector<const PropPoint*>;

std::optional<Eigen::Matrix3d> homography_of(const Points& points) {
    std::vector<Eigen::Vector2d> from;
    std::vector<Eigen::Vector2d> to;
    for (const PropPoint* point : points) {
        from.emplace_back(point->prop_m.x, point->prop_m.y);
        to.emplace_back(point->pixel.x, point->pixel.y);
    }
    return homography(from, to);
}

double distance_px(const Eigen::Matrix3d& pixel_from_plane, const PropPoint& point) {
    return (mapped(pixel_from_plane, {point.prop_m.x, point.prop_m.y}) -
            Eigen::Vector2d(point.pixel.x, point.pixel.y))
        .norm();
}

double median_px(const Eigen::Matrix3d& pixel_from_plane, const Points& points) {
    std::vector<double> off;
    for (const PropPoint* point : points) {
        const double distance = distance_px(pixel_from_plane, *point);
        off.push_back(std::isfinite(distance) ? distance : 1e9);
    }
    const auto middle = off.begin() + static_cast<std::ptrdiff_t>(off.size() / 2);
    std::nth_element(off.begin(), middle, off.end());
    return *middle;
}

/// The points of the level that has most of them.
Points on_one_level(const Rest& rest, double& level_m) {
    Points best;
    for (const PropPoint& mine : rest.points) {
        Points alike;
        for (const PropPoint& other : rest.points) {
            if (std::abs(other.prop_m.z - mine.prop_m.z) < same_level_m) {
                alike.push_back(&other);
            }
        }
        if (alike.size() > best.size()) {
            best = std::move(alike);
            level_m = mine.prop_m.z;
        }
    }
    return best;
}

/// Four different points; `state` is that of the random generator.
Points sample_of(const Points& points, std::uint64_t& state) {
    Points left = points;
    Points sample;
    while (sample.size() < 4) {
        state = state * 6364136223846793005U + 1442695040888963407U; // Knuth's
        const std::size_t k = (state >> 33U) % left.size();
        sample.push_back(left[k]);
        left.erase(left.begin() + static_cast<std::ptrdiff_t>(k));
    }
    return sample;
}

std::optional<Eigen::Matrix3d> min_median(const Points& points) {
    std::optional<Eigen::Matrix3d> best;
    double least = 0.0;
    std::uint64_t state = 1;
    const int samples = points.size() == 4 ? 1 : sample_count;
    for (int k = 0; k < samples; ++k) {
        const auto tried = homography_of(sample_of(points, state));
        if (!tried) {
            continue;
        }
        if (const double median = median_px(*tried, points); !best || median < least) {
            best = tried;
            least = median;
        }
    }
    return best;
}

} // namespace

glm::dvec2 PlaneView::pixel(const glm::dvec2& plane_point) const {
    const Eigen::Vector2d u = mapped(pixel_from_plane, {plane_point.x, plane_point.y});
    return {u.x(), u.y()};
}

std::optional<PlaneView> plane_view(const Rest& rest) {
    PlaneView view;
    const Points points = on_one_level(rest, view.level_m);
    if (points.size() < 4) {
        return std::nullopt;
    }
    const auto rough = min_median(points);
    if (!rough) {
        return std::nullopt;
    }
    const double limit = std::clamp(4.0 * median_px(*rough, points), min_limit_px, max_limit_px);
    Points fitting;
    for (const PropPoint* point : points) {
        if (distance_px(*rough, *point) < limit) {
            fitting.push_back(point);
        }
    }
    const auto fine = homography_of(fitting);
    if (!fine || 2 * fitting.size() < points.size()) {
        return std::nullopt;
    }
    view.pixel_from_plane = *fine;
    for (const PropPoint& point : rest.points) {
        view.on_level.push_back(std::abs(point.prop_m.z - view.level_m) < same_level_m);
        view.fits.push_back(view.on_level.back() && distance_px(*fine, point) < limit);
    }
    // +x and +y of the prop, seen from above, against +u and +v: v points down, so the orientation flips
    // unless the picture is mirrored.
    const glm::dvec2 middle(points[0]->prop_m.x, points[0]->prop_m.y);
    const glm::dvec2 along_x = view.pixel(middle + glm::dvec2(1e-3, 0.0)) - view.pixel(middle);
    const glm::dvec2 along_y = view.pixel(middle + glm::dvec2(0.0, 1e-3)) - view.pixel(middle);
    view.is_mirrored = along_x.x * along_y.y - along_x.y * along_y.x > 0.0;
    return view;
}

} // namespace frustumscreen::calibration
