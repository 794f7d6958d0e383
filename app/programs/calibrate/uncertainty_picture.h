/// How uncertain a calibration's picture is, seen from above: on the table, and at the height of the prop's top.
///
/// Colour   the root mean square of how far the light is off, one standard deviation, in millimetres; both fields have one scale.
/// Frame    T, its +X to the right, +Y up. Crosses lie where their light is, in the field whose height is the nearer one.
/// Threads  as Typesetter.
#pragma once

#include "app/calibration/calibrate_touch.h"
#include "app/exhibit/text_image.h"
#include "app/image/image.h"

#include <span>

namespace frustumscreen {

/// `calibration` has a table.
[[nodiscard]] Image8 uncertainty_picture(const TouchCalibration& calibration, std::span<const Touch> touches,
                                         double top_m, const Typesetter& typesetter);

} // namespace frustumscreen
