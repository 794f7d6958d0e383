#include "app/calibration/corner_uncertainty.h"

#include "app/calibration/picture_shares.h"
#include "app/geometry/table_plane.h"

#include <array>
#include <cassert>
#include <cmath>

namespace frustumscreen::calibration {

namespace {

/// Where a pixel's light falls at a height, in the frame in which the corners were measured.
std::optional<glm::dvec2> light_of(const CornerCalibration& calibration, const glm::dvec2& pixel,
                                   double height_m) {
    if (!calibration.pinhole) {
        return std::nullopt;
    }
    geometry::RigidTransform level_from_projector = calibration.measured_from_projector;
    level_from_projector.translation.z -= height_m;
    return geometry::lights_table(*calibration.pinhole, level_from_projector, pixel);
}

/// Degrees of freedom: each corner has two residuals, across its ray; four rays through one point have eleven
/// unknowns.
int freedom_of(std::span<const MeasuredCorner> corners) {
    return 2 * static_cast<int>(corners.size()) - 11;
}

/// Standard deviation of each coordinate, from the corners' distances to the four rays from the centre of
/// projection through their middles.
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
    return std::fmax(std::sqrt(squares / freedom_of(corners)), min_ruler_error_m);
}

/// Move of each place by one coordinate's error of one standard deviation: two rows per place, metres.
Eigen::VectorXd moves_by(const std::vector<PlaceUncertainty>& zone, const CornerCalibration& less,
                         const CornerCalibration& more, double errors_apart) {
    Eigen::VectorXd moves = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(2 * zone.size()));
    for (std::size_t k = 0; k < zone.size(); ++k) {
        const auto from = light_of(less, zone[k].pixel, zone[k].height_m);
        const auto to = light_of(more, zone[k].pixel, zone[k].height_m);
        if (from && to) {
            const glm::dvec2 moved = (*to - *from) / errors_apart;
            moves.segment<2>(static_cast<Eigen::Index>(2 * k)) << moved.x, moved.y;
        }
    }
    return moves;
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
            const glm::dvec2 share = glm::dvec2(glm::uvec2(k % zone_columns, k / zone_columns)) /
                                     glm::dvec2(zone_columns - 1, zone_rows - 1);
            uncertainty.zone.push_back({share * size, height});
        }
    }
    std::vector<MeasuredCorner> changed(corners.begin(), corners.end());
    constexpr double step_m = 1e-5;
    const auto calibrated = [&] {
        return calibrate_corners(changed, calibration.pinhole->width, calibration.pinhole->height);
    };
    Eigen::MatrixXd moves(static_cast<Eigen::Index>(2 * uncertainty.zone.size()),
                          static_cast<Eigen::Index>(3 * corners.size()));
    Eigen::Index column = 0;
    for (MeasuredCorner& corner : changed) {
        for (int axis = 0; axis < 3; ++axis) {
            const double measured = corner.place_m[axis];
            corner.place_m[axis] = measured - step_m;
            const CornerCalibration less = calibrated();
            corner.place_m[axis] = measured + step_m;
            moves.col(column++) =
                moves_by(uncertainty.zone, less, calibrated(), 2.0 * step_m / uncertainty.ruler_error_m);
            corner.place_m[axis] = measured;
        }
    }
    for (std::size_t k = 0; k < uncertainty.zone.size(); ++k) {
        PlaceUncertainty& place = uncertainty.zone[k];
        place.rms_m = moves.middleRows(static_cast<Eigen::Index>(2 * k), 2).norm();
        uncertainty.picture.mean_m += place.rms_m / static_cast<double>(uncertainty.zone.size());
        uncertainty.picture.worst_m = std::fmax(uncertainty.picture.worst_m, place.rms_m);
        uncertainty.picture.each_m.push_back(place.rms_m);
    }
    uncertainty.picture.shares = picture_shares(moves, freedom_of(corners));
    return uncertainty;
}

} // namespace frustumscreen::calibration
