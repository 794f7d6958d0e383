// Calibration by touch: its condition against its error, its noise, and its last step against long double.

#include "app/bench/stability/themes.h"
#include "app/calibration/agreement.h"
#include "app/calibration/calibrate_touch.h"
#include "app/calibration/starts.h"
#include "tests/simulators/table/simulated_table.h"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <array>
#include <cmath>
#include <numbers>

namespace frustumscreen::bench {

namespace {

/// Crosses in a grid over a share of the picture's width and height, on the table and on boards up to a
/// height.
calibration::Touches grid_touches(const simulators::SimulatedTable& table, double share, double block_m,
                                  const calibration::TouchNoise& noise, simulators::SeededNumbers& numbers) {
    const glm::dvec2 size(table.truth.pinhole.width, table.truth.pinhole.height);
    calibration::Touches touches;
    for (int k = 0; k < 15; ++k) {
        const glm::ivec2 place(k % 5, k / 5);
        const glm::dvec2 at = 0.5 + share * (glm::dvec2(place) * glm::dvec2(0.25, 0.5) - 0.5);
        const calibration::Cross cross{at * size, k % 2 == 0 ? 0.0 : block_m,
                                       0.5 * std::numbers::pi * ((7 * k + place.y) % 4)};
        touches.push_back(simulators::simulated_touch(table, {cross, 0.0}, noise, numbers));
    }
    return touches;
}

calibration::TouchNoise times(double factor) {
    const calibration::TouchNoise one;
    return {.position_m = factor * one.position_m,
            .rotation_rad = factor * one.rotation_rad,
            .pixel = factor * one.pixel,
            .block_m = factor * one.block_m};
}

struct Fitted {
    calibration::Fit fit;
    double predicted_m = 0.0; ///< mean over the zone, one standard deviation
    double observed_m = 0.0;
};

Fitted fitted(const simulators::SimulatedTable& table, const calibration::Touches& touches,
              const calibration::TouchNoise& noise) {
    const geometry::Pinhole& p = table.truth.pinhole;
    const calibration::FitSetup setup{
        .noise = noise, .priors = {}, .sensor_height_m = table.sensor_height_m, .upright = {}};
    Fitted out;
    out.fit = calibration::best_fit(touches, setup, calibration::starting_models(touches, p.width, p.height));
    const std::vector<calibration::ZonePlace> places = calibration::zone_places(
        out.fit.model, out.fit.middle, {0.12, touches[0].tracker_from_sensor.rotation});
    out.predicted_m = calibration::picture_uncertainty(
                          places, out.fit.information().ldlt().solve(calibration::Covariance::Identity()))
                          .mean_m;
    if (const auto found = calibration::in_table_frame(out.fit.model)) {
        out.observed_m = simulators::registration_error(table, *found, 0.12).mean_m;
    }
    return out;
}

/// Root mean square of the observed over the predicted error, over several tables.
double observed_over_predicted(double share, double block_m, double noise) {
    constexpr int seeds = 12;
    double square = 0.0;
    for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
        const simulators::SimulatedTable table = simulators::some_table(seed);
        simulators::SeededNumbers numbers(7000 + seed);
        const Fitted one =
            fitted(table, grid_touches(table, share, block_m, times(noise), numbers), times(noise));
        square += std::pow(one.observed_m / one.predicted_m, 2.0) / seeds;
    }
    return std::sqrt(square);
}

/// From crosses all over the picture and high boards to crosses near its middle and low boards.
StabilityResult conditions(const StabilityOptions&) {
    StabilityResult result;
    for (const auto& [share, block_m] : {std::pair(0.92, 0.12), std::pair(0.6, 0.12), std::pair(0.3, 0.12),
                                         std::pair(0.92, 0.03), std::pair(0.3, 0.03)}) {
        result.rows.push_back(
            {fmt::format("crosses over {:.0f} % of the picture, blocks {:.0f} mm: error / predicted",
                         100.0 * share, 1e3 * block_m),
             2.0, observed_over_predicted(share, block_m, 1.0)});
    }
    return result;
}

StabilityResult noises(const StabilityOptions&) {
    StabilityResult result;
    for (const double noise : {0.1, 0.3, 1.0, 2.0, 4.0}) {
        result.rows.push_back({fmt::format("noise {} times the usual one: error / predicted", noise), 2.0,
                               observed_over_predicted(0.92, 0.12, noise)});
    }
    return result;
}

/// Condition of the matrix scaled to a unit diagonal, which removes the influence of units.
double scaled_condition(const calibration::Covariance& information) {
    const calibration::Changes scale = information.diagonal().cwiseSqrt().cwiseInverse();
    const calibration::Covariance scaled = scale.asDiagonal() * information * scale.asDiagonal();
    const Eigen::SelfAdjointEigenSolver<calibration::Covariance> parts(scaled, Eigen::EigenvaluesOnly);
    return parts.eigenvalues()[calibration::unknown_count - 1] / parts.eigenvalues()[0];
}

/// The uncertainty's own arithmetic: the information matrix inverted in 64-bit, and in long double by
/// Gauss-Jordan elimination.
StabilityResult inverse_in_long_double(const StabilityOptions&) {
    StabilityResult result;
    for (const double share : {0.92, 0.3, 0.1}) {
        const simulators::SimulatedTable table = simulators::some_table(3);
        simulators::SeededNumbers numbers(7003);
        const Fitted one = fitted(table, grid_touches(table, share, 0.12, {}, numbers), {});
        const calibration::Covariance information = one.fit.information();
        const calibration::Covariance covariance =
            information.ldlt().solve(calibration::Covariance::Identity());
        constexpr std::size_t unknowns = calibration::unknown_count;
        using Row = std::array<long double, 2 * unknowns>;
        std::array<Row, unknowns> rows{};
        for (std::size_t r = 0; r < unknowns; ++r) {
            for (std::size_t c = 0; c < unknowns; ++c) {
                rows[r][c] = information(static_cast<int>(r), static_cast<int>(c));
            }
            rows[r][unknowns + r] = 1.0L;
        }
        for (std::size_t k = 0; k < unknowns; ++k) { // positive definite: no pivoting needed
            const long double pivot = rows[k][k];
            for (long double& value : rows[k]) {
                value /= pivot;
            }
            for (std::size_t r = 0; r < unknowns; ++r) {
                const long double times_row = r == k ? 0.0L : rows[r][k];
                for (std::size_t c = 0; c < rows[r].size(); ++c) {
                    rows[r][c] -= times_row * rows[k][c];
                }
            }
        }
        double off = 0.0;
        for (std::size_t k = 0; k < unknowns; ++k) {
            const auto exact = static_cast<double>(rows[k][unknowns + k]);
            const double variance = covariance(static_cast<int>(k), static_cast<int>(k));
            off = std::fmax(off, std::abs(std::sqrt(variance / exact) - 1.0));
        }
        result.rows.push_back(
            {fmt::format("crosses over {:.0f} %: standard deviations off, relative", 100.0 * share),
             0x1p-53 * scaled_condition(information), off});
    }
    return result;
}

} // namespace

std::vector<StabilityCase> calibration_cases() {
    return {
        {"calibration", "from good to bad crosses", FloatingPoint::Free, conditions},
        {"calibration", "noise 0.1 to 4 times", FloatingPoint::Free, noises},
        {"calibration", "normal equations against long double", FloatingPoint::Free, inverse_in_long_double}};
}

} // namespace frustumscreen::bench
