#include "app/calibration/picture_shares.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

namespace frustumscreen::calibration {

namespace {

constexpr Eigen::Index draw_count = 1000;

/// Normally distributed numbers by Box and Muller: std::normal_distribution differs between libraries.
class NormalNumbers {
public:
    double next() {
        const double radius = std::sqrt(-2.0 * std::log(even()));
        return radius * std::cos(2.0 * std::numbers::pi * even());
    }

private:
    /// Uniform in (0, 1].
    double even() { return (static_cast<double>(bits_() >> 11U) + 1.0) * 0x1p-53; }

    std::mt19937_64 bits_{1};
};

/// The quantile of `share`.
double quantile(std::vector<double> values, double share) {
    const auto at = static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
    std::nth_element(values.begin(), values.begin() + at, values.end());
    return values[static_cast<std::size_t>(at)];
}

} // namespace

PictureShares picture_shares(const Eigen::MatrixXd& moves_by_error, int freedom) {
    NormalNumbers numbers;
    Eigen::MatrixXd draws(moves_by_error.cols(), draw_count);
    for (Eigen::Index draw = 0; draw < draw_count; ++draw) {
        double squares = 0.0;
        for (int k = 0; k < freedom; ++k) {
            squares += std::pow(numbers.next(), 2.0);
        }
        const double spread = freedom > 0 ? std::sqrt(freedom / squares) : 1.0;
        for (Eigen::Index k = 0; k < draws.rows(); ++k) {
            draws(k, draw) = spread * numbers.next();
        }
    }
    const Eigen::MatrixXd moves = moves_by_error * draws;
    std::vector<double> off;
    std::vector<double> worst;
    for (Eigen::Index draw = 0; draw < draw_count; ++draw) {
        double farthest = 0.0;
        for (Eigen::Index row = 0; row + 1 < moves.rows(); row += 2) {
            off.push_back(std::hypot(moves(row, draw), moves(row + 1, draw)));
            farthest = std::fmax(farthest, off.back());
        }
        worst.push_back(farthest);
    }
    return off.empty() ? PictureShares{}
                       : PictureShares{quantile(off, 0.68), quantile(off, 0.95), quantile(worst, 0.95)};
}

PictureShares picture_shares(std::span<const ZonePlace> places, const Covariance& covariance) {
    Eigen::MatrixXd rows(static_cast<Eigen::Index>(2 * places.size()),
                         static_cast<Eigen::Index>(unknown_count));
    for (std::size_t k = 0; k < places.size(); ++k) {
        rows.middleRows(static_cast<Eigen::Index>(2 * k), 2) = places[k].rows;
    }
    const Eigen::LLT<Eigen::MatrixXd> root{Eigen::MatrixXd(covariance)};
    const Eigen::MatrixXd lower = root.matrixL();
    return picture_shares(Eigen::MatrixXd(rows * lower), 0);
}

} // namespace frustumscreen::calibration
