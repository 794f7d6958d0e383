/// How uncertain the picture is on the prop, all over the zone: from the table up to the prop's top, all of the projector's picture.
///
/// A prop's place is taken from the tracker and lit by the projector: what counts is where that light is, beside where it should be.
/// So the tracker's registration is in it as much as the projector.
/// Threads  pure; any.
#pragma once

#include "app/calibration/unknowns.h"

#include <span>
#include <vector>

namespace frustumscreen {

/// How far the light of a place moves on the table's plane for a small change of each unknown, in metres.
using LightRows = Eigen::Matrix<double, 2, unknown_count>;

/// A place of the zone, with a prop upright on it.
struct ZonePlace {
    glm::dvec2 pixel{0.0};
    double height_m = 0.0;
    LightRows rows;
};

struct ZoneSetup {
    double top_m = 0.12; ///< the prop's height
    glm::dquat upright{1.0, 0.0, 0.0,
                       0.0}; ///< an upright prop's sensor, in K; it is turned about the vertical
};

/// Places all over the zone, for four turns of the prop each; `middle` as the unknowns have it.
[[nodiscard]] std::vector<ZonePlace> zone_places(const TouchModel& model, const glm::dvec3& middle,
                                                 const ZoneSetup& setup);

/// A height's places are a grid over the picture, row by row from its top left corner to the bottom right one.
inline constexpr std::size_t zone_columns = 7, zone_rows = 5;

/// How far the light is off at most, by shares (picture_shares.h).
struct PictureShares {
    double usual_m = 0.0; ///< at 68 of 100 places
    double most_m = 0.0;  ///< at 95 of 100 places
    double worst_m = 0.0; ///< at the worst place, in 95 of 100 calibrations
};

/// Root mean square of how far the light is off, one standard deviation.
struct PictureUncertainty {
    double mean_m = 0.0;          ///< over the zone
    double worst_m = 0.0;         ///< where it is largest
    std::vector<double> each_m{}; ///< of each place
    PictureShares shares{};       ///< where they were asked for
};
[[nodiscard]] PictureUncertainty picture_uncertainty(std::span<const ZonePlace> places,
                                                     const Covariance& covariance);

/// Of the picture at a place of the zone: root mean square over the prop's turns.
struct PlaceUncertainty {
    glm::dvec2 pixel{0.0};
    double height_m = 0.0;
    double rms_m = 0.0;
};
/// The turns of the prop at each place together: zone_columns x zone_rows of each height, from the table up.
[[nodiscard]] std::vector<PlaceUncertainty> by_place(std::span<const ZonePlace> places,
                                                     std::span<const double> each_m);

} // namespace frustumscreen
