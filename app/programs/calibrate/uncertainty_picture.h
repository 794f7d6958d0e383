/// A picture of a calibration's uncertainty, seen from above: on the table, and at the height of the prop's
/// top.
///
/// Colour   the root mean square error of the light, one standard deviation, in millimetres; both fields have
///          one scale.
/// Frame    T, its +X to the right, +Y up. A measured place is drawn where its light falls, in the field with
///          the nearer height.
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

namespace frustumscreen::programs {

/// The data of a calibration that are drawn.
struct UncertaintyMap {
    calibration::Verdict verdict = calibration::Verdict::Refused;
    geometry::Pinhole pinhole;
    geometry::RigidTransform table_from_projector;
    calibration::PictureUncertainty uncertainty;
    std::vector<calibration::PlaceUncertainty>
        zone; ///< zone_columns x zone_rows of each height, from the table up
};
/// Nothing if the calibration was refused; so in all three.
[[nodiscard]] std::optional<UncertaintyMap> map_of(const calibration::TouchCalibration& calibration);
[[nodiscard]] std::optional<UncertaintyMap> map_of(const calibration::TouchUp& touched_up);
[[nodiscard]] std::optional<UncertaintyMap> map_of(const calibration::CornerCalibration& calibration,
                                                   const calibration::CornerUncertainty& uncertainty);

/// A measured place: the projector's pixel that lights it, and its height above the table.
struct MeasuredPlace {
    glm::dvec2 pixel{0.0};
    double height_m = 0.0;
    int number = 0; ///< number shown to people
};
struct MeasuredPlaces {
    std::string what; ///< the noun for one of them, e.g. "a touched cross"
    std::vector<MeasuredPlace> places;
};
[[nodiscard]] MeasuredPlaces places_of(std::span<const calibration::Touch> touches);
/// The middle of each rest's points.
[[nodiscard]] MeasuredPlaces places_of(std::span<const calibration::Rest> rests);
/// The picture's measured corners, for a picture `width` x `height`.
[[nodiscard]] MeasuredPlaces places_of(std::span<const calibration::MeasuredCorner> corners, int width,
                                       int height);

[[nodiscard]] image::Image8 uncertainty_picture(const UncertaintyMap& map, const MeasuredPlaces& measured,
                                                double top_m, const typography::Typesetter& typesetter);
/// Writes the picture as PNG, if there is a map.
[[nodiscard]] Result<void> write_uncertainty(const std::filesystem::path& file,
                                             const std::optional<UncertaintyMap>& map,
                                             const MeasuredPlaces& measured, double top_m);

} // namespace frustumscreen::programs
