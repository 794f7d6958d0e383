/// How uncertain a calibration's picture is, seen from above: on the table, and at the height of the prop's top.
///
/// Colour   the root mean square of how far the light is off, one standard deviation, in millimetres; both fields have one scale.
/// Frame    T, its +X to the right, +Y up. What was measured lies where its light is, in the field whose height is the nearer one.
/// Threads  as Typesetter.
#pragma once

#include "app/calibration/calibrate_touch.h"
#include "app/calibration/corner_uncertainty.h"
#include "app/calibration/rest.h"
#include "app/calibration/touch_up.h"
#include "app/image/image.h"
#include "app/typography/text_image.h"
#include "firmware_host/base/result.h"

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace frustumscreen {

/// What is drawn of a calibration.
struct UncertaintyMap {
    Verdict verdict = Verdict::Refused;
    Pinhole pinhole;
    RigidTransform table_from_projector;
    PictureUncertainty uncertainty;
    std::vector<PlaceUncertainty> zone; ///< zone_columns x zone_rows of each height, from the table up
};
/// Nothing where the calibration was refused, as in all three.
[[nodiscard]] std::optional<UncertaintyMap> map_of(const TouchCalibration& calibration);
[[nodiscard]] std::optional<UncertaintyMap> map_of(const TouchUp& touched_up);
[[nodiscard]] std::optional<UncertaintyMap> map_of(const CornerCalibration& calibration,
                                                   const CornerUncertainty& uncertainty);

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
/// Of the picture's corners; of a picture `width` x `height`.
[[nodiscard]] MeasuredPlaces places_of(std::span<const MeasuredCorner> corners, int width, int height);

[[nodiscard]] Image8 uncertainty_picture(const UncertaintyMap& map, const MeasuredPlaces& measured,
                                         double top_m, const Typesetter& typesetter);
/// Writes it as PNG, where there is a map.
[[nodiscard]] Result<void> write_uncertainty(const std::filesystem::path& file,
                                             const std::optional<UncertaintyMap>& map,
                                             const MeasuredPlaces& measured, double top_m);

} // namespace frustumscreen
