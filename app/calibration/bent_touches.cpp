#include "app/calibration/bent_touches.h"

#include "app/calibration/agreement.h"
#include "app/calibration/reliability.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace frustumscreen {

namespace {

constexpr double most_chance = 0.01;
constexpr double least_gain = 0.1; ///< of the root mean square: less is not worth a map
constexpr double most_scatter = 2.0;

/// Noise found over noise expected, if the touches agree with the map; nothing if they do not.
std::optional<double> scatter_of(const BentFit& bent) {
    const auto agrees = [&](double scatter) {
        const double scale = scatter * scatter;
        if (!(bent.chi2 / scale < chi2_limit(bent.fit.freedom))) {
            return false;
        }
        for (std::size_t k = 0; k < bent.rows.size(); ++k) {
            if (!(left_out_chi2(bent.rows[k], bent.residuals[k], bent.covariance) / scale <=
                  touch_chi2_limit)) {
                return false;
            }
        }
        return true;
    };
    // The map's priors count as much as its numbers: the fit's own degrees of freedom stay.
    const double scatter = std::sqrt(bent.chi2 / std::max(1, bent.fit.freedom));
    if (agrees(1.0)) {
        return 1.0;
    }
    return scatter < most_scatter && agrees(scatter) ? std::optional(scatter) : std::nullopt;
}

double root_mean_square(std::span<const TouchResidual> residuals) {
    double sum = 0.0;
    for (const TouchResidual& residual : residuals) {
        sum += residual.on_table_m * residual.on_table_m;
    }
    return std::sqrt(sum / static_cast<double>(residuals.size()));
}

} // namespace

double signed_rank_chance(std::span<const double> differences) {
    std::vector<double> sorted(differences.begin(), differences.end());
    std::sort(sorted.begin(), sorted.end(), [](double a, double b) { return std::abs(a) < std::abs(b); });
    double positive = 0.0;
    for (std::size_t k = 0; k < sorted.size(); ++k) {
        positive += sorted[k] > 0.0 ? static_cast<double>(k + 1) : 0.0;
    }
    // From fifteen pairs on the sum of ranks is normal to a thousandth.
    const auto n = static_cast<double>(sorted.size());
    const double mean = n * (n + 1.0) / 4.0;
    const double sigma = std::sqrt(n * (n + 1.0) * (2.0 * n + 1.0) / 24.0);
    return 0.5 * std::erfc((positive - 0.5 - mean) / (sigma * std::numbers::sqrt2));
}

std::optional<BentTouches> find_bend(std::span<const Touch> touches, const FitSetup& setup,
                                     const Fit& without) {
    if (touches.size() < least_for_field) {
        return std::nullopt;
    }
    const FieldMap box = box_around(touches, without.model);
    if (!is_spread(touches, box)) {
        return std::nullopt;
    }
    const std::optional<double> bend_m = likely_bend_m(touches, setup, without, box);
    if (!bend_m) {
        return std::nullopt;
    }
    BentTouches found;
    found.bent = fit_bent(touches, {}, setup, without.model, box, *bend_m);
    const std::optional<double> scatter = scatter_of(found.bent);
    if (!scatter) {
        return std::nullopt;
    }
    found.scatter = *scatter;
    const std::vector<TouchResidual> before = left_out_residuals(touches, {}, setup, without.model);
    found.residuals = left_out_residuals(touches, setup, found.bent, *bend_m);
    std::vector<double> gains;
    for (std::size_t k = 0; k < touches.size(); ++k) {
        const glm::dvec3& place = touches[k].tracker_from_sensor.translation;
        gains.push_back(before[k].on_table_m - found.residuals[k].on_table_m);
        found.largest_bend_m =
            std::fmax(found.largest_bend_m, glm::distance(place, found.bent.map.place(place)));
    }
    found.without_map_m = root_mean_square(before);
    found.with_map_m = root_mean_square(found.residuals);
    found.chance = signed_rank_chance(gains);
    const bool gains_enough = found.with_map_m <= (1.0 - least_gain) * found.without_map_m;
    return found.chance <= most_chance && gains_enough ? std::optional(std::move(found)) : std::nullopt;
}

} // namespace frustumscreen
