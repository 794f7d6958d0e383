#include "app/calibration/plane_view.h"

#include <Eigen/Geometry>
#include <Eigen/SVD>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>

namespace frustumscreen {

namespace {

constexpr double same_level_m = 1e-3;
/// A lens's distortion over a sheet is not in a homography: some pixels are allowed.
constexpr double least_limit_px = 4.0;
constexpr double most_limit_px = 12.0;
/// With three of ten points wrong, a quarter of the samples are right: that none of so many is has a chance of 1e-14.
constexpr int sample_count = 120;

using Points = std::vector<const PropPoint*>;

/// Maps points about their middle to a mean distance of 1.
Eigen::Matrix3d scaling(std::span<const Eigen::Vector2d> points) {
    Eigen::Vector2d middle = Eigen::Vector2d::Zero();
    for (const Eigen::Vector2d& point : points) {
        middle += point / static_cast<double>(points.size());
    }
    double reach = 1e-12;
    for (const Eigen::Vector2d& point : points) {
        reach += (point - middle).norm() / static_cast<double>(points.size());
    }
    Eigen::Matrix3d scale = Eigen::Matrix3d::Identity() / reach;
    scale.col(2) << -middle / reach, 1.0;
    return scale;
}

/// By the direct linear transformation. Nothing if the points do not span a plane.
std::optional<Eigen::Matrix3d> homography(const Points& points) {
    std::vector<Eigen::Vector2d> from;
    std::vector<Eigen::Vector2d> to;
    for (const PropPoint* point : points) {
        from.emplace_back(point->prop_m.x, point->prop_m.y);
        to.emplace_back(point->pixel.x, point->pixel.y);
    }
    const Eigen::Matrix3d scale_from = scaling(from);
    const Eigen::Matrix3d scale_to = scaling(to);
    Eigen::Matrix<double, Eigen::Dynamic, 9> equations(static_cast<Eigen::Index>(2 * points.size()), 9);
    equations.setZero();
    for (std::size_t k = 0; k < points.size(); ++k) {
        const Eigen::Vector3d x = scale_from * from[k].homogeneous();
        const Eigen::Vector3d u = scale_to * to[k].homogeneous();
        const auto row = static_cast<Eigen::Index>(2 * k);
        equations.block<1, 3>(row, 0) = x.transpose();
        equations.block<1, 3>(row, 6) = -u.x() * x.transpose();
        equations.block<1, 3>(row + 1, 3) = x.transpose();
        equations.block<1, 3>(row + 1, 6) = -u.y() * x.transpose();
    }
    const Eigen::JacobiSVD<Eigen::MatrixXd> svd(equations, Eigen::ComputeFullV);
    if (!(svd.singularValues()[7] > 1e-2)) {
        return std::nullopt;
    }
    const Eigen::VectorXd h = svd.matrixV().col(8);
    Eigen::Matrix3d scaled;
    scaled << h.segment<3>(0).transpose(), h.segment<3>(3).transpose(), h.segment<3>(6).transpose();
    return scale_to.inverse() * scaled * scale_from;
}

double distance_px(const Eigen::Matrix3d& pixel_from_plane, const PropPoint& point) {
    const Eigen::Vector3d u = pixel_from_plane * Eigen::Vector3d(point.prop_m.x, point.prop_m.y, 1.0);
    return (u.head<2>() / u.z() - Eigen::Vector2d(point.pixel.x, point.pixel.y)).norm();
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

/// The level with most points.
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

/// Four different points of so many; `state` goes on from sample to sample.
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

std::optional<Eigen::Matrix3d> least_median(const Points& points) {
    std::optional<Eigen::Matrix3d> best;
    double least = 0.0;
    std::uint64_t state = 1;
    const int samples = points.size() == 4 ? 1 : sample_count;
    for (int k = 0; k < samples; ++k) {
        const auto tried = homography(sample_of(points, state));
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
    const Eigen::Vector3d u = pixel_from_plane * Eigen::Vector3d(plane_point.x, plane_point.y, 1.0);
    return {u.x() / u.z(), u.y() / u.z()};
}

std::optional<PlaneView> plane_view(const Rest& rest) {
    PlaneView view;
    const Points points = on_one_level(rest, view.level_m);
    if (points.size() < 4) {
        return std::nullopt;
    }
    const auto rough = least_median(points);
    if (!rough) {
        return std::nullopt;
    }
    const double limit = std::clamp(4.0 * median_px(*rough, points), least_limit_px, most_limit_px);
    Points fitting;
    for (const PropPoint* point : points) {
        if (distance_px(*rough, *point) < limit) {
            fitting.push_back(point);
        }
    }
    const auto fine = homography(fitting);
    if (!fine || 2 * fitting.size() < points.size()) {
        return std::nullopt;
    }
    view.pixel_from_plane = *fine;
    for (const PropPoint& point : rest.points) {
        view.on_level.push_back(std::abs(point.prop_m.z - view.level_m) < same_level_m);
        view.fits.push_back(view.on_level.back() && distance_px(*fine, point) < limit);
    }
    // +x and +y of the prop, seen from above, against +u and +v, which goes down: the sense turns over, or the picture is mirrored.
    const glm::dvec2 middle(points[0]->prop_m.x, points[0]->prop_m.y);
    const glm::dvec2 along_x = view.pixel(middle + glm::dvec2(1e-3, 0.0)) - view.pixel(middle);
    const glm::dvec2 along_y = view.pixel(middle + glm::dvec2(0.0, 1e-3)) - view.pixel(middle);
    view.is_mirrored = along_x.x * along_y.y - along_x.y * along_y.x > 0.0;
    return view;
}

} // namespace frustumscreen
