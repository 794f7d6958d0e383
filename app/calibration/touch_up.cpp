#include "app/calibration/touch_up.h"

#include "app/calibration/agreement.h"
#include "app/calibration/check_touches.h"
#include "app/calibration/picture_limits.h"
#include "app/calibration/reliability.h"
#include "app/calibration/upright_touches.h"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

namespace frustumscreen::calibration {

namespace {

/// Limits for few touches. They check each other little, and all of them count, so an unnoticed error must
/// stay within what the verdict promises.
constexpr PictureLimits few_good{for_good.mean_m, for_good.worst_m, 5e-3};
constexpr PictureLimits few_usable{for_usable.mean_m, for_usable.worst_m, 8e-3};
/// Least difference of chi squared that names one explanation: likelihood ratio 20.
constexpr double apart = 6.0;

struct Explanation {
    TouchModel model;
    double chi2 = 0.0;
    Covariance covariance; ///< of the model's unknowns, as far as the move changes them
    std::vector<TouchRows> rows;
};

double chi2_of(const WhitenedTouches& seen) {
    double chi2 = 0.0;
    for (const Eigen::Vector3d& residual : seen.residuals) {
        chi2 += residual.squaredNorm();
    }
    return chi2;
}

Explanation explained(std::span<const Touch> touches, const FitSetup& setup, const TouchModel& kept,
                      Moved which) {
    const glm::dvec3 middle = middle_of(touches);
    const RigidMove weights = usual_move_weights();
    RigidMove move = RigidMove::Zero();
    Explanation out;
    constexpr int steps = 12; // Gauss-Newton steps; few are needed from so near
    for (int step = 0; step <= steps; ++step) {
        out.model = moved_model(kept, which, move, middle);
        const WhitenedTouches seen = whitened_touches(touches, setup, out.model, middle);
        const ByRigidMove unknowns = by_move(out.model, which);
        Eigen::Matrix<double, 6, 6> information = weights.asDiagonal();
        RigidMove slope = weights.cwiseProduct(move);
        for (std::size_t k = 0; k < touches.size(); ++k) {
            const Eigen::Matrix<double, 3, 6> rows = seen.rows[k] * unknowns;
            information += rows.transpose() * rows;
            slope += rows.transpose() * seen.residuals[k];
        }
        const Eigen::LDLT<Eigen::Matrix<double, 6, 6>> solver(information);
        out.chi2 = chi2_of(seen) + move.dot(weights.cwiseProduct(move));
        out.covariance =
            unknowns * solver.solve(Eigen::Matrix<double, 6, 6>::Identity()) * unknowns.transpose();
        out.rows = seen.rows;
        if (step < steps) {
            move -= solver.solve(slope);
        }
    }
    return out;
}

TouchUp refused(VerdictReason reason) {
    TouchUp result;
    result.reason = std::move(reason);
    return result;
}

std::vector<TouchResidual> residuals_at(const TouchModel& model, std::span<const Touch> touches) {
    std::vector<TouchResidual> residuals;
    for (const Touch& touch : touches) {
        residuals.push_back(
            residual_of(model, model.touched(touch.tracker_from_sensor), touch.block_m, touch.pixel));
    }
    return residuals;
}

/// Leave-one-out residual of each touch, for the same explanation.
std::vector<TouchResidual> left_out(std::span<const Touch> touches, const FitSetup& noise,
                                    const TouchModel& kept, Moved which) {
    std::vector<TouchResidual> residuals;
    for (std::size_t k = 0; k < touches.size(); ++k) {
        std::vector<Touch> others(touches.begin(), touches.end());
        others.erase(others.begin() + static_cast<std::ptrdiff_t>(k));
        residuals.push_back(
            residuals_at(explained(others, noise, kept, which).model, touches.subspan(k, 1)).front());
    }
    return residuals;
}

/// Mean distance over the zone between the light that the kept table chooses and the place that it means to
/// light.
double off_by(const TouchModel& kept, const TouchModel& now, std::span<const ZonePlace> places) {
    double sum = 0.0;
    double count = 0.0;
    for (const ZonePlace& place : places) {
        const auto there = now.lit(place.pixel, place.height_m);
        const auto pixel = there ? kept.pixel(*there) : std::nullopt;
        if (const auto lit = pixel ? now.lit(*pixel, place.height_m) : std::nullopt) {
            sum += glm::distance(*lit, *there);
            count += 1.0;
        }
    }
    return sum / std::fmax(1.0, count);
}

std::string what_moved(Moved moved) {
    switch (moved) {
    case Moved::Projector:
        return "the projector moved";
    case Moved::Tracker:
        return "the tracker's source moved";
    default:
        return "the projector or the tracker's source moved (these touches do not tell which)";
    }
}

/// If nothing moved, all equations check each other; but a few touches do not reveal a small move.
void judge_unmoved(TouchUp& result) {
    if (result.uncertainty.mean_m <= for_good.mean_m) {
        result.verdict = Verdict::Good;
        result.reason = {"touch_up.unmoved", "nothing moved: the kept calibration holds"};
    } else {
        result.verdict = Verdict::Usable;
        result.reason = {
            "touch_up.nearly_unmoved",
            "nothing moved by more than two or three millimetres: the kept calibration holds; two more "
            "touches would tell more"};
    }
}

void judge(TouchUp& result) {
    if (result.moved == Moved::Nothing) {
        judge_unmoved(result);
        return;
    }
    const std::string found = fmt::format("{}, and the picture was {:.1f} mm off on average",
                                          what_moved(result.moved), 1e3 * result.off_m);
    if (few_good.keep(result.uncertainty, result.hidden_error_m)) {
        result.verdict = Verdict::Good;
        result.reason = {"touch_up.moved", found};
    } else if (few_usable.keep(result.uncertainty, result.hidden_error_m)) {
        result.verdict = Verdict::Usable;
        result.reason = {"touch_up.usable", found + "; with more touches the correction would be good"};
    } else {
        result.verdict = Verdict::Repeat;
        result.reason = {"touch_up.unchecked",
                         found + "; the touches are too few to check each other: touch two more crosses, on "
                                 "another height"};
    }
}

std::vector<ZonePlace> zone_of(const TouchModel& model, std::span<const Touch> touches, double top_m) {
    const std::vector<bool> upright = upright_ones(touches, model.table_up);
    const auto some = std::find(upright.begin(), upright.end(), true) - upright.begin();
    return zone_places(model, middle_of(touches),
                       {top_m, touches[static_cast<std::size_t>(some)].tracker_from_sensor.rotation});
}

/// The kept table, corrected for the move.
CalibratedTable corrected(const CalibratedTable& kept, const Explanation& best, bool by_tracker) {
    CalibratedTable table = kept;
    if (by_tracker) {
        table.table_from_tracker = kept.table_from_projector * best.model.projector_from_tracker;
    } else {
        table.table_from_projector = kept.table_from_tracker * best.model.projector_from_tracker.inverse();
    }
    return table;
}

} // namespace

TouchUp touch_up(const CalibratedTable& kept, std::span<const Touch> touches, const TouchSetup& setup) {
    if (auto reason = refusal_of_few(touches, setup.width, setup.height)) {
        return refused(std::move(*reason));
    }
    FitSetup noise{.noise = setup.noise, .priors = {}, .sensor_height_m = std::nullopt, .upright = {}};
    noise.noise.position_m = std::hypot(setup.noise.position_m, kept_error_m);
    const TouchModel before = model_of(kept);
    const double unmoved = chi2_of(whitened_touches(touches, noise, before, middle_of(touches)));
    const Explanation projector = explained(touches, noise, before, Moved::Projector);
    const Explanation tracker = explained(touches, noise, before, Moved::Tracker);
    const bool by_tracker = tracker.chi2 < projector.chi2;
    const Explanation& best = by_tracker ? tracker : projector;
    const int equations = 3 * static_cast<int>(touches.size());
    const bool something = unmoved - best.chi2 > chi2_limit(6);
    if (!(something ? best.chi2 < chi2_limit(equations - 6) : unmoved < chi2_limit(equations))) {
        return refused({"touch_up.contradict",
                        "the touches contradict each other, or projector and tracker both moved: "
                        "touch the crosses again, or calibrate completely"});
    }
    const std::vector<ZonePlace> places = zone_of(best.model, touches, setup.top_m);
    TouchUp result;
    result.table = kept;
    result.uncertainty = picture_uncertainty(places, best.covariance);
    result.zone = by_place(places, result.uncertainty.each_m);
    result.hidden_error_m = hidden_error_m(best.rows, best.covariance, places);
    if (something) {
        result.moved = std::abs(tracker.chi2 - projector.chi2) < apart ? Moved::Either
                       : by_tracker                                    ? Moved::Tracker
                                                                       : Moved::Projector;
        result.table = corrected(kept, best, by_tracker);
        result.off_m = off_by(before, best.model, places);
    }
    result.residuals = something
                           ? left_out(touches, noise, before, by_tracker ? Moved::Tracker : Moved::Projector)
                           : residuals_at(before, touches); // the kept table is independent of the touches
    judge(result);
    return result;
}

} // namespace frustumscreen::calibration
