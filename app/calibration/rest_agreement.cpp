#include "app/calibration/rest_agreement.h"

#include "app/calibration/dense_solvers.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>

namespace frustumscreen::calibration {

namespace {

/// At most a fifth of the rests, and this share of the points, counts as wrong.
constexpr std::size_t wrong_of = 5;
constexpr double max_wrong_points = 0.4;
constexpr double max_scatter = 2.0;
/// A dozen rests do not estimate their noise better; less scatter is chance.
constexpr double min_scatter = 1.4;
/// Quantile of chi squared for a point's two residuals; one right point in 250 000 exceeds it.
constexpr double point_chi2_limit = 25.0;
/// Limits of the estimated pixel noise.
constexpr double min_noise_px = 0.05;
constexpr double max_noise_px = 1.0;
/// Medians of chi squared with two and with six degrees of freedom.
constexpr double median_of_2 = 1.386;
constexpr double median_of_6 = 5.348;

constexpr std::array first_rounds{25};
constexpr std::array next_rounds{8};
constexpr std::array last_rounds{10, 10};

double median(std::vector<double> values) {
    if (values.empty()) {
        return 0.0;
    }
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

/// Weights 1 for the points of each level that fit together; points off the level follow later. Rests without
/// a view get no weight.
RestWeights first_weights(std::span<const Rest> rests, std::span<const std::optional<PlaneView>> views) {
    RestWeights weights = equal_weights(rests);
    for (std::size_t k = 0; k < rests.size(); ++k) {
        for (std::size_t j = 0; j < rests[k].points.size(); ++j) {
            weights.points[k][j] = views[k] && views[k]->fits[j] ? 1.0 : no_weight;
        }
        weights.rests[k] = views[k] ? 1.0 : no_weight;
    }
    return weights;
}

RestWeights cauchy_weights(const RestFit& fit, double pixel_noise, double width) {
    RestWeights weights;
    for (const FittedRest& rest : fit.rests) {
        weights.rests.push_back(1.0 / (1.0 + rest.pose.squaredNorm() / (6.0 * width * width)));
        weights.points.emplace_back();
        for (const glm::dvec2& off : rest.points) {
            const double own = glm::dot(off, off) / (pixel_noise * pixel_noise);
            weights.points.back().push_back(1.0 / (1.0 + own / (2.0 * width * width)));
        }
    }
    return weights;
}

double noise_found(const RestFit& fit) {
    std::vector<double> squares;
    for (const FittedRest& rest : fit.rests) {
        for (const glm::dvec2& off : rest.points) {
            squares.push_back(glm::dot(off, off));
        }
    }
    return std::clamp(std::sqrt(median(std::move(squares)) / median_of_2), min_noise_px, max_noise_px);
}

RestFit robust_fit(std::span<const Rest> rests, std::span<const std::optional<PlaneView>> views,
                   const RestFitSetup& setup, std::span<const RestModel> starts) {
    const RestWeights weights = first_weights(rests, views);
    std::optional<RestFit> best;
    for (const RestModel& start : starts) {
        RestFit fit = fit_rests(rests, weights, setup, start, first_rounds);
        if (std::isfinite(fit.chi2) && (!best || fit.chi2 < best->chi2)) {
            best = std::move(fit);
        }
    }
    for (const double width : {20.0, 10.0, 5.0, 3.0, 3.0, 3.0}) {
        best = fit_rests(rests, cauchy_weights(*best, setup.noise.pixel, width), setup, best->model,
                         next_rounds);
    }
    return std::move(*best);
}

/// Leave-one-out chi squared of each rest's report, with six degrees of freedom.
std::vector<double> left_out_chi2(const RestFit& fit) {
    const RestCovariance covariance = inverse_of(fit.information());
    std::vector<double> chi2;
    for (const FittedRest& rest : fit.rests) {
        const Eigen::Matrix<double, 6, 1> off = rest.by_pose.transpose() * rest.residuals;
        chi2.push_back(off.dot(unexplained(rest, covariance).ldlt().solve(off)));
    }
    return chi2;
}

/// Ratio of the reports' noise to the expected noise; 1 unless most rests scatter beyond chance.
double scatter_of(const std::vector<double>& chi2) {
    const double scatter = std::sqrt(median(chi2) / median_of_6);
    return scatter > min_scatter ? scatter : 1.0;
}

/// Leaves out points beyond the noise and returns their share.
double leave_points_out(AgreeingRests& found, double pixel_noise) {
    double wrong = 0.0;
    double count = 0.0;
    for (std::size_t k = 0; k < found.fit.rests.size(); ++k) {
        for (std::size_t j = 0; j < found.weights.points[k].size(); ++j) {
            const glm::dvec2& off = found.fit.rests[k].points[j];
            const bool is_wrong = glm::dot(off, off) > point_chi2_limit * pixel_noise * pixel_noise;
            found.weights.points[k][j] = is_wrong ? no_weight : 1.0;
            wrong += is_wrong ? 1.0 : 0.0;
            count += 1.0;
        }
    }
    return wrong / count;
}

} // namespace

PoseCovariance unexplained(const FittedRest& rest, const RestCovariance& covariance) {
    const Eigen::Matrix<double, rest_unknown_count, 6> moves = rest.by_unknown.transpose() * rest.by_pose;
    return rest.by_pose.transpose() * rest.by_pose - moves.transpose() * covariance * moves;
}

AgreeingRests find_agreement(std::span<const Rest> rests, std::span<const std::optional<PlaneView>> views,
                             const RestFitSetup& given, std::span<const RestModel> starts) {
    AgreeingRests found;
    found.fit = robust_fit(rests, views, given, starts);
    found.weights = equal_weights(rests);
    RestFitSetup setup = given;
    found.pixel_noise = setup.noise.pixel = noise_found(found.fit);
    for (int round = 0; round < 2; ++round) {
        if (leave_points_out(found, setup.noise.pixel) > max_wrong_points) {
            return found;
        }
        found.fit = fit_rests(rests, found.weights, setup, found.fit.model, last_rounds);
    }
    while (true) {
        std::vector<double> chi2 = left_out_chi2(found.fit);
        for (const std::size_t k : found.wrong) {
            chi2[k] = 0.0;
        }
        found.scatter = scatter_of(chi2);
        const auto worst = std::max_element(chi2.begin(), chi2.end());
        if (*worst < rest_chi2_limit * std::pow(std::min(found.scatter, max_scatter), 2.0)) {
            break;
        }
        found.wrong.push_back(static_cast<std::size_t>(worst - chi2.begin()));
        if (wrong_of * found.wrong.size() > rests.size()) {
            return found;
        }
        found.weights.rests[found.wrong.back()] = no_weight;
        found.fit = fit_rests(rests, found.weights, setup, found.fit.model, last_rounds);
    }
    std::sort(found.wrong.begin(), found.wrong.end());
    if (found.scatter < max_scatter) {
        found.agreement = !found.wrong.empty()  ? Agreement::Without
                          : found.scatter > 1.0 ? Agreement::Scattered
                                                : Agreement::All;
    }
    return found;
}

} // namespace frustumscreen::calibration
