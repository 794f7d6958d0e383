/// The map that takes back what metal near the tracker does to the places that it reports, found from touches together with the model.
///
/// Method   after the model's own fit: least squares of what it leaves, the model held, with a prior around zero on the map's thirty numbers (ridge), as
///          wide as makes the residuals likeliest; then both once more. To fit them together was tried: where the field bends more than
///          the map can follow, the sensor's place in the prop gave way, and the picture got worse. Rotations stay as they are reported.
/// Frames   K and the box of FieldMap.
/// Threads  pure; any.
#pragma once

#include "app/calibration/fit.h"
#include "app/calibration/zone.h"
#include "app/geometry/field_map.h"

#include <optional>

namespace frustumscreen {

/// From fewer touches no map is made: the model alone has eighteen unknowns of their 45 equations.
inline constexpr std::size_t least_for_field = 15;

struct BentFit {
    FieldMap map;
    Fit fit;                                ///< of the touches as the map takes them back
    std::vector<Eigen::Matrix3Xd> rows;     ///< of each touch, whitened: the model's unknowns, then the map's
    std::vector<Eigen::Vector3d> residuals; ///< whitened
    Eigen::MatrixXd covariance;             ///< of all of these unknowns
    double chi2 = 0.0;                      ///< of residuals and priors
};

/// An empty map, its box around the reported places, along the picture's rows and upright.
[[nodiscard]] FieldMap box_around(std::span<const Touch> touches, const TouchModel& model);

/// Whether a touch lies in each ninth of the box, seen from above: a map must be held where it bends, and crosses that are chosen for the model alone
/// crowd at the picture's corners.
[[nodiscard]] bool is_spread(std::span<const Touch> touches, const FieldMap& box);

/// The prior's width under which the residuals of a fit without a map are most likely; nothing if they are likelier without one.
[[nodiscard]] std::optional<double> likely_bend_m(std::span<const Touch> touches, const FitSetup& setup,
                                                  const Fit& without, const FieldMap& box);

/// `weights` as fit_touches has them; `bend_m`: the prior's standard deviation of each of the map's numbers.
[[nodiscard]] BentFit fit_bent(std::span<const Touch> touches, std::span<const double> weights,
                               const FitSetup& setup, const TouchModel& start, const FieldMap& box,
                               double bend_m);

[[nodiscard]] Touches taken_back(std::span<const Touch> touches, const FieldMap& map);

/// How far the light of each place moves for a small change of the model's unknowns and the map's.
[[nodiscard]] std::vector<Eigen::Matrix2Xd> light_rows_with(const FieldMap& map,
                                                            std::span<const ZonePlace> places);

} // namespace frustumscreen
