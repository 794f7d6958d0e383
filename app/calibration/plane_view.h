/// How a rest's points lie in the projector's picture: the homography of the level of the prop that has most of them, and which points it fits.
///
/// It needs neither tracker nor projector, so that wrong points are found before either is known.
/// Method   least median of squares over samples of four points, then least squares of those that fit. The same points give the same answer.
/// Threads  pure; any.
/// Source   Rousseeuw, Least median of squares regression, 1984; Hartley and Zisserman, Multiple view geometry, 2004, 4.1 (homography)
#pragma once

#include "app/calibration/rest.h"

#include <Eigen/Core>

namespace frustumscreen {

struct PlaneView {
    Eigen::Matrix3d pixel_from_plane =
        Eigen::Matrix3d::Identity(); ///< (x, y, 1) of the prop's points at that level
    double level_m = 0.0;            ///< their z
    std::vector<bool> on_level;      ///< of each point of the rest
    std::vector<bool> fits;          ///< on the level, and where the others say
    bool is_mirrored = false;        ///< seen from above, the picture is a mirror's

    [[nodiscard]] glm::dvec2 pixel(const glm::dvec2& plane_point) const;
};

/// Nothing, if no level has four points that span it, or if most of them do not fit together.
[[nodiscard]] std::optional<PlaneView> plane_view(const Rest& rest);

} // namespace frustumscreen
