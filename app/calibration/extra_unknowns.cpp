#include "app/calibration/extra_unknowns.h"

#include "app/calibration/dense_solvers.h"

#include <cmath>

namespace frustumscreen::calibration {

FittedTouches fitted(std::span<const Touch> touches, const FitSetup& setup, const TouchModel& start) {
    FittedTouches out{.fit = fit_touches(touches, {}, setup, start), .whitened = {}, .covariance = {}};
    out.whitened = whitened_touches(touches, setup, out.fit.model, out.fit.middle);
    out.covariance = inverse_of(out.fit.information());
    return out;
}

Gain gain_by(const FittedTouches& fitted, std::span<const ExtraColumns> columns) {
    const Eigen::Index count = columns[0].cols();
    Eigen::MatrixXd information = Eigen::MatrixXd::Zero(count, count);
    Eigen::MatrixXd shared = Eigen::MatrixXd::Zero(unknown_count, count);
    Eigen::VectorXd slope = Eigen::VectorXd::Zero(count);
    for (std::size_t k = 0; k < columns.size(); ++k) {
        information += columns[k].transpose() * columns[k];
        shared += fitted.whitened.rows[k].transpose() * columns[k];
        slope += columns[k].transpose() * fitted.whitened.residuals[k];
    }
    const double weak =
        1e-9 * information.trace(); // a disturbance that the fit takes up wholly gains nothing
    information -= shared.transpose() * fitted.covariance * shared;
    information.diagonal().array() += weak;
    Gain gain;
    gain.values = -inverse_of(information) * slope;
    gain.chi2 = std::fmax(0.0, -slope.dot(gain.values));
    return gain;
}

} // namespace frustumscreen::calibration
