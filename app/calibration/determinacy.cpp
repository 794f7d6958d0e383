#include "app/calibration/determinacy.h"

#include "app/calibration/dense_solvers.h"

#include <cmath>

namespace frustumscreen::calibration {

namespace {

/// Largest standard deviation of the sensor's place in the prop that counts as determined.
constexpr double widest_offset_m = 8e-3;
/// Largest mean standard deviation of the picture over the zone that counts as determined.
constexpr double widest_picture_m = 6e-3;

} // namespace

std::optional<Undetermined> undetermined(const Fit& fit, const ZoneSetup& zone) {
    // The last term is a weak prior: what is undetermined is some hundred metres or radians wide, not
    // infinite.
    const Covariance known =
        fit.from_touches + fit.from_height + fit.from_priors / 100.0 + 1e-5 * Covariance::Identity();
    const Covariance covariance = inverse_of(known);
    const SymmetricAxes offsets = axes_of(covariance.block<3, 3>(offset_x, offset_x));
    if (std::sqrt(offsets.values[1]) > widest_offset_m) {
        return Undetermined{Undetermined::What::SensorAcross};
    }
    if (std::sqrt(offsets.values[2]) > widest_offset_m) {
        const Eigen::Vector3d up_in_sensor = eigen(zone.upright).transpose() * eigen(fit.model.table_up);
        const bool upwards = std::abs(offsets.vectors.col(2).dot(up_in_sensor)) > 0.7;
        return Undetermined{upwards ? Undetermined::What::SensorAbove : Undetermined::What::SensorAcross};
    }
    const PictureUncertainty left = picture_uncertainty(zone_places(fit.model, fit.middle, zone), covariance);
    if (!(left.mean_m < widest_picture_m)) {
        return Undetermined{Undetermined::What::Picture, std::fmin(left.mean_m, 9.999)};
    }
    return std::nullopt;
}

PriorShares prior_shares(const Fit& fit) {
    const Covariance covariance = inverse_of(fit.information());
    const auto share = [&](Unknown which) {
        return std::fmin(1.0, covariance(which, which) * fit.from_priors(which, which));
    };
    return {.aspect = share(aspect_log),
            .centre_u = share(centre_u),
            .centre_v = share(centre_v),
            .k1 = share(lens_k1),
            .k2 = share(lens_k2)};
}

} // namespace frustumscreen::calibration
