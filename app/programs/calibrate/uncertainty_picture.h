/// How uncertain a calibration's picture is, seen from above: on the table, and at the height of the prop's top.
///
/// Colour   the root mean square of how far the light is off, one standard deviation, in millimetres; both fields have one scale.
/// Frame    T, its +X to the right, +Y up. What was measured lies where its light is, in the field whose height is the nearer one.
/// Threads  as Typesetter.
#pragma once

#include "app/calibration/calibrate_touch.h"
#include "app/calibration/rest.h"
#include "app/exhibit/text_image.h"
#include "app/image/image.h"
#include "firmware_host/base/result.h"

#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace frustumscreen {

/// A place that was measured: the projector's pixel that lights it, and how high it is above the table.
struct MeasuredPlace {
    glm::dvec2 pixel{0.0};
    double height_m = 0.0;
    int number = 0; ///< that people know it by
};
struct MeasuredPlaces {
    std::string what; ///< one of them is, in words: "a touched cross"
    std::vector<MeasuredPlace> places;
};
[[nodiscard]] MeasuredPlaces places_of(std::span<const Touch> touches);
/// The middle of each rest's points.
[[nodiscard]] MeasuredPlaces places_of(std::span<const Rest> rests);

/// `calibration` has a table.
[[nodiscard]] Image8 uncertainty_picture(const TouchCalibration& calibration, const MeasuredPlaces& measured,
                                         double top_m, const Typesetter& typesetter);
/// Writes it as PNG; nothing where the calibration was refused.
[[nodiscard]] Result<void> write_uncertainty(const std::filesystem::path& file,
                                             const TouchCalibration& calibration,
                                             const MeasuredPlaces& measured, double top_m);

} // namespace frustumscreen
