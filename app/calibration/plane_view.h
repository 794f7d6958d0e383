/// The homography from the prop's level that has most of a rest's points to the projector's picture, and the
/// points that it fits.
///
/// Wrong points are found this way without tracker and projector.
/// Method   Least median of squares over samples of four points, then least squares over the points that fit.
///          Deterministic.
/// Threads  pure; any.
/// Source   Rousseeuw, Least median of squares regression, 1984; Hartley and Zisserman, Multiple view
///          geometry, 2004, 4.1 (homography)
#pragma once

#include "app/calibration/rest.h"

#include <Eigen/Core>

namespace frustumscreen::calibration {

struct PlaneView {
    Eigen::Matrix3d pixel_from_plane =
        Eigen::Matrix3d::Identity(); ///< (x, y, 1) of the prop's points at that level
    double level_m = 0.0;            ///< their z
    std::vector<bool> on_level;      ///< of each point of the rest
    std::vector<bool> fits;          ///< on the level, and consistent with the homography
    bool is_mirrored = false;        ///< the picture, seen from above, is mirrored

    [[nodiscard]] glm::dvec2 pixel(const glm::dvec2& plane_point) const;
};

/// Nothing if no level has four points that span it, or if most of them do not fit together.
[[nodiscard]] std::optional<PlaneView> plane_view(const Rest& rest);

} // namespace frustumscreen::calibration
