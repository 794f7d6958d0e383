#include "app/calibration/corner_uncertainty.h"

#include "app/geometry/table_plane.h"

#include <array>
#include <cassert>
#include <cmath>

namespace frustumscreen {

namespace {

/// Where a pixel's light is at a height, in the frame that the corners were measured in.
std::optional<glm::dvec2> light_of(const CornerCalibration& calibration, const glm::dvec2& pixel,
                                   double height_m) {
    if (!calibration.pinhole) {
        return std::nullopt;
    }
    RigidTransform level_from_projector = calibration.measured_from_projector;
    level_from_projector.translation.z -= height_m;
    return lights_table(*calibration.pinhole, level_from_projector, pixel);
}

/// Standard deviation of each coordinate: how far the corners lie beside the four lines from the centre of projection to their middles.
double ruler_error_m(const glm::dvec3& centre_m, std::span<const MeasuredCorner> corners) {
    std::array<glm::dvec3, 4> along{};
    for (const MeasuredCorner& corner : corners) {
        along[static_cast<std::size_t>(corner.corner)] += corner.place_m - centre_m;
    }
    double squares = 0.0;
    for (const MeasuredCorner& corner : corners) {
        const glm::dvec3 line = glm::normalize(along[static_cast<std::size_t>(corner.corner)]);
        const glm::dvec3 from = corner.place_m - centre_m;
        const glm::dvec3 off = from - glm::dot(from, line) * line;
        squares += glm::dot(off, off);
    }
    // A corner counts in the two directions across its line; four lines through one point have eleven unknowns.
    const double left_over = 2.0 * static_cast<double>(corners.size()) - 11.0;
    return std::fmax(std::sqrt(squares / left_over), least_ruler_error_m);
}

/// What one coordinate's error adds to the square of each place's, in metres.
void add_error(std::vector<PlaceUncertainty>& zone, const CornerCalibration& less,
               const CornerCalibration& more, double errors_apart) {
    for (PlaceUncertainty& place : zone) {
        const auto from = light_of(less, place.pixel, place.height_m);
        const auto to = light_of(more, place.pixel, place.height_m);
        if (from && to) {
            const glm::dvec2 moved = (*to - *from) / errors_apart;
            place.rms_m += glm::dot(moved, moved);
        }
    }
}

} // namespace

CornerUncertainty uncertainty_of(const CornerCalibration& calibration,
                                 std::span<const MeasuredCorner> corners, double top_m) {
    assert(calibration.pinhole);
    const glm::dvec2 size(calibration.pinhole->width, calibration.pinhole->height);
    CornerUncertainty uncertainty;
    uncertainty.ruler_error_m = ruler_error_m(calibration.centre_m, corners);
    for (const double height : {0.0, 0.5 * top_m, top_m}) {
        for (std::size_t k = 0; k < zone_columns * zone_rows; ++k) {
            const glm::dvec2 share(static_cast<double>(k % zone_columns) / (zone_columns - 1),
                                   static_cast<double>(k / zone_columns) / (zone_rows - 1));
            uncertainty.zone.push_back({share * size, height});
        }
    }
    std::vector<MeasuredCorner> changed(corners.begin(), corners.end());
    constexpr double step_m = 1e-5;
    const auto calibrated = [&] {
        return calibrate_corners(changed, calibration.pinhole->width, calibration.pinhole->height);
    };
    for (MeasuredCorner& corner : changed) {
        for (int axis = 0; axis < 3; ++axis) {
            const double measured = corner.place_m[axis];
            corner.place_m[axis] = measured - step_m;
            const CornerCalibration less = calibrated();
            corner.place_m[axis] = measured + step_m;
            add_error(uncertainty.zone, less, calibrated(), 2.0 * step_m / uncertainty.ruler_error_m);
            corner.place_m[axis] = measured;
        }
    }
    for (PlaceUncertainty& place : uncertainty.zone) {
        place.rms_m = std::sqrt(place.rms_m);
        uncertainty.picture.mean_m += place.rms_m / static_cast<double>(uncertainty.zone.size());
        uncertainty.picture.worst_m = std::fmax(uncertainty.picture.worst_m, place.rms_m);
        uncertainty.picture.each_m.push_back(place.rms_m);
    }
    return uncertainty;
}

} // namespace frustumscreen
