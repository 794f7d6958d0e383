/// Starts of the fit to touches: rough models, of which the one with the best fit counts.
///
/// They come from the direct linear transformation, if the touches determine one, and from projectors at
/// several throws that look straight down. Both equate the sensor with the touched place: the fit finds the
/// offset.
/// Threads  pure; any.
/// Source   Hartley, In defense of the eight-point algorithm, 1997 (the scaling); Hartley and Zisserman, Multiple view
///          geometry, 2004, 6.1 and 7.1 (camera matrix from points)
#pragma once

#include "app/calibration/touch.h"
#include "app/calibration/touch_model.h"

#include <span>

namespace frustumscreen::calibration {

/// Least squares: height above the table = dot(up, x) + offset. `up` is not normalised: its length reveals
/// wrong units.
struct HeightFit {
    glm::dvec3 up{0.0};
    double offset_m = 0.0;
};
[[nodiscard]] HeightFit fit_heights(std::span<const Touch> touches);

/// Least squares: pixel = across * x + at_origin.
struct PixelFit {
    glm::dvec3 across_u{0.0}, across_v{0.0}; ///< pixels a metre, in K
    glm::dvec2 at_origin{0.0};
};
[[nodiscard]] PixelFit fit_pixels(std::span<const Touch> touches);

/// If all touches are at one height, `up` is normal to their plane.
[[nodiscard]] std::vector<TouchModel> starting_models(std::span<const Touch> touches, int width, int height);

/// The start that looks straight down, with a focal length in pixels.
[[nodiscard]] TouchModel start_with(std::span<const Touch> touches, int width, int height, double focal_px);

} // namespace frustumscreen::calibration
