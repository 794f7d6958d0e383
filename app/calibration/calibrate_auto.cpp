#include "app/calibration/calibrate_auto.h"

#include "app/calibration/check_rests.h"
#include "app/calibration/check_touches.h"
#include "app/calibration/dense_solvers.h"
#include "app/calibration/picture_shares.h"
#include "app/calibration/reliability.h"
#include "app/calibration/rest_agreement.h"
#include "app/calibration/rest_starts.h"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <utility>

namespace frustumscreen::calibration {

namespace {

/// A larger scale error comes from the printer's driver, not from damp air.
constexpr double max_print_off = 5e-3;

AutoCalibration refused(VerdictReason reason) {
    AutoCalibration calibration;
    calibration.found.reason = std::move(reason);
    return calibration;
}

/// The touches' part of a fit, with the rests' own unknowns and their priors marginalised, so that it can be
/// judged as a fit to touches.
Fit touch_part(const RestFit& fit) {
    constexpr int more = int{rest_unknown_count} - int{unknown_count};
    const Eigen::Matrix<double, more, more> tail = fit.information().bottomRightCorner<more, more>();
    const Eigen::Matrix<double, unknown_count, more> across =
        fit.from_rests.topRightCorner<unknown_count, more>(); // priors and height do not couple them
    Fit part;
    part.model = fit.model.touch;
    part.middle = fit.middle;
    part.from_touches = fit.from_rests.topLeftCorner<unknown_count, unknown_count>() -
                        across * tail.ldlt().solve(across.transpose());
    part.from_height = fit.from_height.topLeftCorner<unknown_count, unknown_count>();
    part.from_priors = fit.from_priors.topLeftCorner<unknown_count, unknown_count>();
    return part;
}

/// Mean residual of a rest's weighted points at a model that was fitted to the other rests.
TouchResidual mean_residual(const Rest& rest, std::span<const double> weights, const RestModel& others) {
    TouchResidual residual;
    double count = 0.0;
    for (std::size_t k = 0; k < rest.points.size(); ++k) {
        if (weights[k] <= no_weight) {
            continue;
        }
        const glm::dvec3 place =
            (rest.tracker_from_sensor * others.prop_in_sensor()).point(others.printed(rest.points[k].prop_m));
        const TouchResidual one =
            residual_of(others.touch, place, others.touch.height(place), rest.points[k].pixel);
        residual.on_table_m += one.on_table_m;
        residual.pixel += one.pixel;
        count += 1.0;
    }
    return {residual.on_table_m / std::fmax(1.0, count), residual.pixel / std::fmax(1.0, count)};
}

/// Leave-one-out residual of each rest, to second order: one Gauss-Newton step from the fit of all rests.
std::vector<TouchResidual> residuals_of(std::span<const Rest> rests, const AgreeingRests& found) {
    const RestCovariance information = found.fit.information();
    std::vector<TouchResidual> residuals;
    for (std::size_t k = 0; k < rests.size(); ++k) {
        const FittedRest& mine = found.fit.rests[k];
        const RestCovariance others = information - mine.by_unknown.transpose() * mine.by_unknown;
        const RestChanges change = others.ldlt().solve(mine.by_unknown.transpose() * mine.residuals);
        residuals.push_back(mean_residual(rests[k], found.weights.points[k],
                                          changed(found.fit.model, found.fit.middle, change)));
    }
    return residuals;
}

double hidden_error_of(const AgreeingRests& found, std::span<const ZonePlace> places) {
    const RestCovariance covariance = inverse_of(found.fit.information());
    std::vector<UnseenError<6>> unseen;
    for (std::size_t k = 0; k < found.fit.rests.size(); ++k) {
        if (std::binary_search(found.wrong.begin(), found.wrong.end(), k)) {
            continue; // it is left out of the fit
        }
        const FittedRest& rest = found.fit.rests[k];
        const Eigen::Matrix<double, rest_unknown_count, 6> moves =
            covariance * rest.by_unknown.transpose() * rest.by_pose;
        unseen.push_back({moves.topRows<unknown_count>(), unexplained(rest, covariance).inverse()});
    }
    return hidden_error_m(std::span<const UnseenError<6>>(unseen), rest_chi2_limit, places);
}

constexpr MeasuredKind prop_rests{
    .one = "rest",
    .many = "rests",
    .scattered = "tracker's reports",
    .why_scattered = "did the prop not stand still",
    .three_more = "let the prop rest at three more places",
    .spread = "let the prop rest at more places, spread over the picture and two heights",
    .tilt = "let the prop lean"};

std::vector<std::string> names_of(std::span<const std::size_t> wrong, std::span<const Rest> rests) {
    std::vector<std::string> names;
    for (const std::size_t k : wrong) {
        names.push_back(fmt::format("{}", rests[k].name));
    }
    return names;
}

void count_wrong_points(AutoCalibration& calibration, const RestWeights& weights) {
    for (const std::vector<double>& points : weights.points) {
        calibration.points_wrong.push_back(static_cast<std::size_t>(
            std::count_if(points.begin(), points.end(), [](double weight) { return weight <= no_weight; })));
    }
}

/// The rests with one mistake undone, and a clause that names the mistake.
struct Mistake {
    Rests undone;
    MessageId id;
    std::string_view what;
};

/// Mistakes that affect all rests at once.
std::vector<Mistake> mistakes_in(std::span<const Rest> rests) {
    const std::size_t count = rests.size();
    Rests mirrored(rests.begin(), rests.end());
    Rests next = mirrored;
    Rests before = mirrored;
    for (std::size_t k = 0; k < count; ++k) {
        for (PropPoint& point : mirrored[k].points) {
            point.prop_m.x = -point.prop_m.x;
        }
        next[k].tracker_from_sensor = rests[(k + 1) % count].tracker_from_sensor;
        before[k].tracker_from_sensor = rests[(k + count - 1) % count].tracker_from_sensor;
    }
    return {
        {std::move(mirrored), "rests.agree_if_mirrored",
         "the points are mirrored: is the board printed from behind, or does the "
         "camera turn its picture round?"},
        {std::move(next), "rests.agree_if_next", "each rest's points belong to the report of the next one"},
        {std::move(before), "rests.agree_if_before",
         "each rest's points belong to the report of the one before"}};
}

/// The mistake whose correction makes most rests agree; nothing if none does.
std::optional<VerdictReason> cause_of(std::span<const Rest> rests, const AutoSetup& setup) {
    for (const Mistake& mistake : mistakes_in(rests)) {
        std::vector<std::optional<PlaneView>> views;
        for (const Rest& rest : mistake.undone) {
            views.push_back(plane_view(rest));
        }
        if (refusal_of(mistake.undone, setup.width, setup.height) || refusal_of(mistake.undone, views)) {
            continue;
        }
        const AgreeingRests found =
            find_agreement(mistake.undone, views, {setup.noise, setup.priors, setup.sensor_height_m},
                           starting_rest_models(mistake.undone, views, setup.width, setup.height));
        if (found.agreement != Agreement::None) {
            return VerdictReason{
                mistake.id,
                fmt::format("the rests contradict each other as given, and agree if {}", mistake.what)};
        }
    }
    return std::nullopt;
}

/// Judges rests that agree; refuses them if they leave something undetermined.
AutoCalibration judged(std::span<const Rest> rests, const AutoSetup& setup, const AgreeingRests& found) {
    const Fit fit = touch_part(found.fit);
    const auto standing =
        std::find_if(rests.begin(), rests.end(), [](const Rest& rest) { return rest.block_m.has_value(); });
    const ZoneSetup zone{setup.top_m, standing->tracker_from_sensor.rotation};
    if (const auto open = undetermined(fit, zone)) {
        return refused(in_words(*open, prop_rests));
    }
    AutoCalibration calibration;
    TouchCalibration& table = calibration.found;
    table.table = in_table_frame(fit.model);
    if (!table.table) {
        return refused({"rests.off_table", "the light of the picture's middle does not meet the table"});
    }
    if (const double off = found.fit.model.print - 1.0; std::abs(off) > max_print_off) {
        return refused(
            {"rests.print_size",
             fmt::format(
                 "the board is printed {:.1f} % too {}: print it at 100 %, without fitting it to the page",
                 100.0 * std::abs(off), off > 0.0 ? "large" : "small")});
    }
    calibration.sensor_from_prop = found.fit.model.prop_in_sensor();
    calibration.pixel_noise = found.pixel_noise;
    calibration.print = found.fit.model.print;
    count_wrong_points(calibration, found.weights);
    const std::vector<ZonePlace> places = zone_places(fit.model, fit.middle, zone);
    const Covariance covariance = found.scatter * found.scatter * inverse_of(fit.information());
    table.uncertainty = picture_uncertainty(places, covariance);
    table.uncertainty.shares = picture_shares(places, covariance);
    table.zone = by_place(places, table.uncertainty.each_m);
    table.hidden_error_m = hidden_error_of(found, places);
    table.prior_shares = prior_shares(fit);
    table.residuals = residuals_of(rests, found);
    double highest_m = 0.0;
    for (const Rest& rest : rests) {
        highest_m = std::fmax(highest_m, rest.block_m.value_or(0.0));
    }
    table.boards = boards_of(fit.model, covariance, highest_m);
    judge(table, prop_rests, found, names_of(found.wrong, rests));
    table.reason.sentence += in_words(table.boards);
    return calibration;
}

} // namespace

AutoCalibration calibrate_auto(std::span<const Rest> rests, const AutoSetup& setup) {
    if (auto reason = refusal_of(rests, setup.width, setup.height)) {
        return refused(cause_of(rests, setup).value_or(std::move(*reason)));
    }
    std::vector<std::optional<PlaneView>> views;
    for (const Rest& rest : rests) {
        views.push_back(plane_view(rest));
    }
    if (auto reason = refusal_of(rests, views)) {
        return refused(cause_of(rests, setup).value_or(std::move(*reason)));
    }
    const RestFitSetup fit_setup{setup.noise, setup.priors, setup.sensor_height_m};
    const AgreeingRests found = find_agreement(rests, views, fit_setup,
                                               starting_rest_models(rests, views, setup.width, setup.height));
    if (found.agreement == Agreement::None) {
        return refused(
            cause_of(rests, setup)
                .value_or(VerdictReason{
                    "rests.contradict",
                    "the rests contradict each other, and no single mistake explains it: points of another "
                    "prop, metal near the tracker, or a projector that moved meanwhile; begin again without "
                    "metal, and with the projector fixed"}));
    }
    return judged(rests, setup, found);
}

} // namespace frustumscreen::calibration
