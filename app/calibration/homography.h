/// The homography that maps points of one plane to points of another, by least squares.
///
/// Method   The direct linear transformation, with both sides centred and scaled.
/// Threads  pure; any.
/// Source   Hartley, In defense of the eight-point algorithm, 1997; Hartley and Zisserman, Multiple view
///          geometry, 2004, 4.1
#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <span>

namespace frustumscreen::calibration {

/// `from` and `to` have the same length. Nothing for fewer than four points, or if they do not span a plane.
[[nodiscard]] std::optional<Eigen::Matrix3d> homography(std::span<const Eigen::Vector2d> from,
                                                        std::span<const Eigen::Vector2d> to);

[[nodiscard]] inline Eigen::Vector2d mapped(const Eigen::Matrix3d& homography, const Eigen::Vector2d& point) {
    const Eigen::Vector3d out = homography * point.homogeneous();
    return out.head<2>() / out.z();
}

} // namespace frustumscreen::calibration
