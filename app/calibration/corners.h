/// Calibration by hand, as in the paper: the picture's four corners, measured at two distances or more.
///
/// The points of one corner lie on a ray through the centre of projection. The centre is the least-squares
/// intersection of the four rays. The picture's angles, the lens shift and the pose follow from the four
/// rays, for a lens without distortion. The tracker is not involved.
/// Frames   M: the frame in which the corners were measured, metres. The table's frame T: its z = 0 is M's z
///          = 0.
/// Errors   none: corners that determine nothing are refused with a reason. So is a corner that does not fit:
///          its ray misses the intersection of the three others by more than errors of 5 mm in each
///          coordinate explain in 99 % of cases.
/// Threads  pure; any.
#pragma once

#include "app/calibration/verdict.h"
#include "app/geometry/pinhole.h"
#include "app/geometry/transform.h"

#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace frustumscreen::calibration {

enum class PictureCorner { TopLeft, TopRight, BottomRight, BottomLeft };

[[nodiscard]] glm::dvec2 pixel_of(PictureCorner corner, int width, int height);

struct MeasuredCorner {
    int distance = 0; ///< number of the distance, from 1
    PictureCorner corner = PictureCorner::TopLeft;
    glm::dvec3 place_m{0.0};
};

struct CornerCalibration {
    Verdict verdict = Verdict::Refused;
    VerdictReason reason;
    std::vector<std::size_t>
        repeat; ///< rows to measure again, counted from 0: all of a corner that does not fit
    std::optional<geometry::Pinhole> pinhole; ///< none if refused, as are the members below
    geometry::RigidTransform table_from_projector;
    geometry::RigidTransform measured_from_projector; ///< M from J
    glm::dvec3 centre_m{0.0};                         ///< of projection, in M
    double horizontal_deg = 0.0;                      ///< angle of the picture
    double vertical_deg = 0.0;
    double mean_residual_m = 0.0; ///< distance of the corners from the fitted projector's rays
    double worst_residual_m = 0.0;
    double mean_residual_px = 0.0;
    double worst_residual_px = 0.0;
    double condition =
        0.0; ///< condition of the four rays' intersection: largest over smallest standard deviation
};

/// Assumed error of a corner's coordinate, one standard deviation.
inline constexpr double usual_ruler_error_m = 5e-3;

[[nodiscard]] CornerCalibration calibrate_corners(std::span<const MeasuredCorner> corners, int width,
                                                  int height);

} // namespace frustumscreen::calibration
