/// Uncertainty of the picture on the prop over the zone: all of the projector's picture, from the table up to
/// the prop's top.
///
/// The tracker reports the prop's place and the projector lights it. The error is the distance between where
/// the light falls and where it should fall, so it includes the tracker's registration as well as the
/// projector.
/// Threads  pure; any.
#pragma once

#include "app/calibration/unknowns.h"

#include <span>
#include <vector>

namespace frustumscreen::calibration {

/// Derivatives of where a place's light falls on the table's plane, by each unknown, in metres.
using LightRows = Eigen::Matrix<double, 2, unknown_count>;

/// A place of the zone, with an upright prop on it.
struct ZonePlace {
    glm::dvec2 pixel{0.0};
    double height_m = 0.0;
    LightRows rows;
};

struct ZoneSetup {
    double top_m = 0.12;                    ///< the prop's height
    glm::dquat upright{1.0, 0.0, 0.0, 0.0}; ///< sensor of an upright prop, in K; turned about the vertical
};

/// Places over the zone, for four turns of the prop each; `middle`: as in unknowns.h.
[[nodiscard]] std::vector<ZonePlace> zone_places(const TouchModel& model, const glm::dvec3& middle,
                                                 const ZoneSetup& setup);

/// The places of one height are a grid over the picture, row by row from its top left to its bottom right
/// corner.
inline constexpr std::size_t zone_columns = 7, zone_rows = 5;

/// The light's largest error for shares of places (picture_shares.h).
struct PictureShares {
    double usual_m = 0.0; ///< at 68 of 100 places
    double max_m = 0.0;   ///< at 95 of 100 places
    double worst_m = 0.0; ///< at the worst place, in 95 of 100 calibrations
};

/// Root mean square error of the light, one standard deviation.
struct PictureUncertainty {
    double mean_m = 0.0;          ///< over the zone
    double worst_m = 0.0;         ///< at the worst place
    std::vector<double> each_m{}; ///< of each place
    PictureShares shares{};       ///< if requested
};
[[nodiscard]] PictureUncertainty picture_uncertainty(std::span<const ZonePlace> places,
                                                     const Covariance& covariance);

/// Error of the picture at a place of the zone: root mean square over the prop's turns.
struct PlaceUncertainty {
    glm::dvec2 pixel{0.0};
    double height_m = 0.0;
    double rms_m = 0.0;
};
/// Combines the prop's turns at each place: zone_columns x zone_rows per height, from the table up.
[[nodiscard]] std::vector<PlaceUncertainty> by_place(std::span<const ZonePlace> places,
                                                     std::span<const double> each_m);

} // namespace frustumscreen::calibration
