/// Calibration by hand, as the paper has it: the picture's four corners, measured at two distances or more.
///
/// The corners of one ray lie on a line through the centre of projection: it is where the four lines meet, by least squares. Its angles, lens shift
/// and pose follow from the four rays, for a lens without distortion. There is no tracker in it.
/// Frames   M: the frame in which the corners were measured, metres. The table's frame T: its z = 0 is M's z = 0.
/// Errors   none: corners from which nothing follows are refused with a reason. So are those of which one does not fit: its line misses where the
///          three others meet by more than errors of 5 mm in each coordinate explain once in a hundred times.
/// Threads  pure; any.
/// Source   Kim, Shin, Kim, Using relief texture for interactive and tangible virtual environments, 2008, 'TangibleScreen', step 1
#pragma once

#include "app/calibration/verdict.h"
#include "app/geometry/pinhole.h"
#include "app/geometry/transform.h"

#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace frustumscreen {

enum class PictureCorner { TopLeft, TopRight, BottomRight, BottomLeft };

[[nodiscard]] glm::dvec2 pixel_of(PictureCorner corner, int width, int height);

struct MeasuredCorner {
    int distance = 0; ///< which one it was measured at, from 1
    PictureCorner corner = PictureCorner::TopLeft;
    glm::dvec3 place_m{0.0};
};

struct CornerCalibration {
    Verdict verdict = Verdict::Refused;
    std::string reason;
    std::vector<std::size_t>
        repeat; ///< rows to measure again, counted from 0: those of a corner that does not fit
    std::optional<Pinhole> pinhole; ///< none if refused, as all that follows
    RigidTransform table_from_projector;
    RigidTransform measured_from_projector; ///< M from J
    glm::dvec3 centre_m{0.0};               ///< of projection, in M
    double horizontal_deg = 0.0;            ///< angles of the picture
    double vertical_deg = 0.0;
    double mean_residual_m = 0.0; ///< of the corners from the rays of the projector that was found
    double worst_residual_m = 0.0;
    double mean_residual_px = 0.0;
    double worst_residual_px = 0.0;
    double condition =
        0.0; ///< of the four lines' meeting: how many times as uncertain its worst direction is as its best
};

/// Assumed error of a corner's coordinate, one standard deviation.
inline constexpr double usual_ruler_error_m = 5e-3;

[[nodiscard]] CornerCalibration calibrate_corners(std::span<const MeasuredCorner> corners, int width,
                                                  int height);

} // namespace frustumscreen
