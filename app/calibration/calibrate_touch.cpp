#include "app/calibration/calibrate_touch.h"

#include "app/calibration/check_touches.h"
#include "app/calibration/dense_solvers.h"
#include "app/calibration/picture_limits.h"
#include "app/calibration/picture_shares.h"
#include "app/calibration/reliability.h"
#include "app/calibration/starts.h"
#include "app/calibration/touch_causes.h"
#include "app/calibration/upright_touches.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace frustumscreen::calibration {

namespace {

/// Beyond this, the remaining touches cannot tell which ones are wrong.
constexpr double max_hidden_m = 60e-3;

double hidden_error_of(std::span<const Touch> touches, const FitSetup& setup, const Fit& fit,
                       const ZoneSetup& zone) {
    return hidden_error_m(whitened_touches(touches, setup, fit.model, fit.middle).rows,
                          inverse_of(fit.information()), zone_places(fit.model, fit.middle, zone));
}

TouchCalibration refused(VerdictReason reason) {
    TouchCalibration calibration;
    calibration.reason = std::move(reason);
    return calibration;
}

/// Leave-one-out residual of each touch; `wrong` touches are in no fit.
std::vector<TouchResidual> residuals_of(std::span<const Touch> touches, std::span<const std::size_t> wrong,
                                        const FitSetup& setup, const TouchModel& model) {
    std::vector<TouchResidual> residuals;
    for (std::size_t k = 0; k < touches.size(); ++k) {
        std::vector<double> weights(touches.size(), 1.0);
        for (const std::size_t other : wrong) {
            weights[other] = 0.0;
        }
        weights[k] = 0.0;
        const TouchModel others = fit_touches(touches, weights, setup, model).model;
        residuals.push_back(residual_of(others, others.touched(touches[k].tracker_from_sensor),
                                        others.raised(touches[k].block_m), touches[k].pixel));
    }
    return residuals;
}

Touches without(std::span<const Touch> touches, std::span<const std::size_t> wrong) {
    Touches kept;
    for (std::size_t k = 0; k < touches.size(); ++k) {
        if (std::find(wrong.begin(), wrong.end(), k) == wrong.end()) {
            kept.push_back(touches[k]);
        }
    }
    return kept;
}

/// True if the touches without the wrong ones cannot check each other: then others may be wrong instead.
bool too_few_left(const AgreeingTouches& found, std::span<const Touch> touches, const FitSetup& setup,
                  const ZoneSetup& zone) {
    if (found.agreement != Agreement::Without) {
        return false;
    }
    return hidden_error_of(without(touches, found.wrong), setup, found.fit, zone) > max_hidden_m;
}

constexpr MeasuredKind crosses{.one = "touch",
                               .many = "touches",
                               .scattered = "touches",
                               .why_scattered = "was the prop moved too early",
                               .three_more = "touch three more crosses",
                               .spread = "touch more crosses, spread over the picture and both heights",
                               .tilt = "lay the prop on a side"};

bool keeps(const TouchCalibration& calibration, const PictureLimits& limits) {
    return limits.keep(calibration.uncertainty, calibration.hidden_error_m);
}

/// 99 % quantile of chi squared for a touch's three residuals. A touch beyond it is repeated, not refused.
constexpr double doubtful_chi2 = 11.3;

/// The touch that fits the others least; nothing if it is within the limit.
std::optional<std::size_t> doubtful_one(std::span<const Touch> touches, const FitSetup& setup,
                                        const Fit& fit) {
    const WhitenedTouches whitened = whitened_touches(touches, setup, fit.model, fit.middle);
    const Covariance covariance = inverse_of(fit.information());
    std::optional<std::size_t> doubtful;
    double most = doubtful_chi2;
    for (std::size_t k = 0; k < touches.size(); ++k) {
        const double chi2 = left_out_chi2(whitened.rows[k], whitened.residuals[k], covariance);
        doubtful = chi2 > most ? std::optional(k) : doubtful;
        most = std::fmax(most, chi2);
    }
    return doubtful;
}

/// Lowers the verdict by one: the touch may have slipped by some millimetres.
void doubt(TouchCalibration& calibration, std::size_t touch) {
    if (calibration.verdict == Verdict::Good) {
        calibration.verdict = Verdict::Usable;
        calibration.reason = {
            "verdict.doubtful",
            fmt::format("{}; touch {} fits the others less well than it should: done again, it may be good",
                        calibration.reason.sentence, touch + 1)};
    } else if (calibration.verdict == Verdict::Usable) {
        calibration.verdict = Verdict::Repeat;
        calibration.repeat = {touch};
        calibration.reason = {
            "verdict.repeat_doubtful",
            fmt::format("touch {} fits the others less well than it should: do it again", touch + 1)};
    }
}

/// Sets the mean and worst residuals over all touches except those to repeat.
void summarise_residuals(TouchCalibration& calibration) {
    double count = 0.0;
    for (std::size_t k = 0; k < calibration.residuals.size(); ++k) {
        if (std::find(calibration.repeat.begin(), calibration.repeat.end(), k) == calibration.repeat.end()) {
            const TouchResidual& residual = calibration.residuals[k];
            calibration.mean_residual_m += residual.on_table_m;
            calibration.mean_residual_px += residual.pixel;
            calibration.worst_residual_m = std::fmax(calibration.worst_residual_m, residual.on_table_m);
            calibration.worst_residual_px = std::fmax(calibration.worst_residual_px, residual.pixel);
            count += 1.0;
        }
    }
    calibration.mean_residual_m /= count;
    calibration.mean_residual_px /= count;
}

/// Joins words, 'a, b and c'; at least one.
std::string in_words(std::span<const std::string> words) {
    return words.size() == 1
               ? words[0]
               : fmt::format("{} and {}", fmt::join(words.first(words.size() - 1), ", "), words.back());
}

} // namespace

TouchResidual residual_of(const TouchModel& model, const glm::dvec3& place, double height_m,
                          const glm::dvec2& pixel) {
    constexpr double nowhere = 1e3; // metres and pixels
    const auto lit = model.lit(pixel, height_m);
    const auto seen = model.pixel(place);
    return {lit ? glm::distance(*lit, place) : nowhere, seen ? glm::distance(*seen, pixel) : nowhere};
}

std::string in_words(const PictureUncertainty& uncertainty) {
    const PictureShares& shares = uncertainty.shares;
    return fmt::format(
        "the picture usually lies within {:.1f} mm of its place; 95 of 100 places within {:.1f} mm, "
        "the worst place within {:.1f} mm",
        1e3 * shares.usual_m, 1e3 * shares.max_m, 1e3 * shares.worst_m);
}

bool BoardsHeight::differ() const {
    constexpr double min_m = 5e-4; // a ruler's resolution
    constexpr double sure_sd = 3.0;
    const double off_m = std::abs(found_m - given_m);
    return off_m > min_m && off_m > sure_sd * sd_m;
}

std::string in_words(const std::optional<BoardsHeight>& boards) {
    if (!boards || !boards->differ()) {
        return {};
    }
    return fmt::format("; the boards are {:.1f} mm high, not {:.4g}: set calibration.block_m to {:.4f}",
                       1e3 * boards->found_m, 1e3 * boards->given_m, boards->found_m);
}

std::optional<BoardsHeight> boards_of(const TouchModel& model, const Covariance& covariance, double given_m) {
    if (!(given_m > 0.0)) {
        return std::nullopt;
    }
    return BoardsHeight{.given_m = given_m,
                        .found_m = model.raised(given_m),
                        .sd_m = given_m * std::sqrt(covariance(boards_share, boards_share))};
}

std::vector<std::string> row_names(std::span<const std::size_t> rows) {
    std::vector<std::string> names;
    for (const std::size_t row : rows) {
        names.push_back(fmt::format("{}", row + 1));
    }
    return names;
}

VerdictReason misfits(std::string_view one, std::string_view many, std::span<const std::string> wrong) {
    return {"verdict.misfits",
            wrong.size() == 1
                ? fmt::format("{} {} does not fit the others: do it again", one, wrong[0])
                : fmt::format("{} {} do not fit the others: do them again", many, in_words(wrong))};
}

void judge(TouchCalibration& calibration, const MeasuredKind& kind, const Agreed& found,
           std::span<const std::string> wrong) {
    calibration.repeat = found.wrong;
    summarise_residuals(calibration);
    const auto is = [&](Verdict verdict, VerdictReason reason) {
        calibration.verdict = verdict;
        calibration.reason = std::move(reason);
    };
    const std::string expected = in_words(calibration.uncertainty);
    if (found.agreement == Agreement::Exchanged) {
        is(Verdict::Repeat,
           {"verdict.exchanged",
            fmt::format("{} {} look exchanged: each fits the other's cross", kind.many, in_words(wrong))});
    } else if (found.agreement == Agreement::Without) {
        is(Verdict::Repeat, misfits(kind.one, kind.many, wrong));
    } else if (found.agreement == Agreement::All && keeps(calibration, for_good)) {
        is(Verdict::Good, {"verdict.good", expected});
    } else if (!keeps(calibration, for_usable) && calibration.hidden_error_m > for_usable.hidden_m) {
        is(Verdict::Repeat,
           {"verdict.unchecked",
            fmt::format(
                "the {} agree, but are too few to check each other; a wrong one would go unnoticed: {}",
                kind.many, kind.three_more)});
    } else if (!keeps(calibration, for_usable)) {
        is(Verdict::Repeat,
           {"verdict.uncertain", fmt::format("{}, which is too much: {}", expected, kind.spread)});
    } else if (found.agreement == Agreement::Scattered) {
        is(Verdict::Usable,
           {"verdict.scattered",
            fmt::format("{}; the {} scatter {:.1f} times as much as they should: is metal near, or {}?",
                        expected, kind.scattered, found.scatter, kind.why_scattered)});
    } else {
        is(Verdict::Usable,
           {"verdict.usable", fmt::format("{}; with more {} it would be good", expected, kind.many)});
    }
}

VerdictReason in_words(const Undetermined& open, const MeasuredKind& kind) {
    switch (open.what) {
    case Undetermined::What::SensorAcross:
        return VerdictReason{
            "verdict.sensor_across",
            fmt::format("the prop was turned nearly the same way in every {0}, which does not tell where "
                        "in it the sensor sits: turn it by a quarter from one {0} to the next",
                        kind.one)};
    case Undetermined::What::SensorAbove:
        return VerdictReason{
            "verdict.sensor_height",
            fmt::format(
                "the prop stood upright in every {0}, which does not tell the sensor's height in it from the "
                "tracker's: give it with --sensor-height, or {1} in three of them or more",
                kind.one, kind.tilt)};
    case Undetermined::What::Picture:
        break;
    }
    return VerdictReason{
        "verdict.picture_open",
        fmt::format("these {} tell the picture's place only to {:.0f} mm: spread them over the whole "
                    "picture, half of them on a block as high as the prop",
                    kind.many, 1e3 * open.picture_m)};
}

namespace {

FitSetup fit_setup_for(std::vector<bool> upright, const TouchSetup& setup) {
    return {.noise = setup.noise,
            .priors = setup.priors,
            .sensor_height_m = setup.sensor_height_m,
            .upright = std::move(upright)};
}

} // namespace

TouchCalibration calibrate_touch(std::span<const Touch> touches, const TouchSetup& setup) {
    const auto mistake = [&](const FitSetup& as_given) {
        return mistake_in(touches, as_given, setup.width, setup.height);
    };
    if (auto reason = refusal_of(touches, setup.width, setup.height)) {
        return refused(mistake(fit_setup_for({}, setup)).value_or(std::move(*reason)));
    }
    const std::vector<TouchModel> starts = starting_models(touches, setup.width, setup.height);
    const FitSetup fit_setup = fit_setup_for(upright_ones(touches, starts[0].table_up), setup);
    const AgreeingTouches found = find_agreement(touches, fit_setup, starts);
    const auto some_upright = std::find(fit_setup.upright.begin(), fit_setup.upright.end(), true);
    const ZoneSetup zone{setup.top_m,
                         touches[static_cast<std::size_t>(some_upright - fit_setup.upright.begin())]
                             .tracker_from_sensor.rotation};
    const bool contradict =
        found.agreement == Agreement::None || too_few_left(found, touches, fit_setup, zone);
    if (const auto cause = contradict ? mistake(fit_setup) : std::nullopt) {
        return refused(*cause);
    }
    if (const auto open = undetermined(found.fit, zone)) {
        return refused(in_words(*open, crosses));
    }
    if (const auto cause = found.agreement == Agreement::Exchanged
                               ? std::nullopt
                               : disturbance_of(touches, fit_setup, found)) {
        return refused(*cause);
    }
    if (contradict) {
        return refused({"touches.contradict", "the touches contradict each other, and no single mistake, no "
                                              "move and no metal at one place explains "
                                              "it: several slips, more than one move, or much metal near the "
                                              "tracker; take metal away, fix the "
                                              "projector, and touch the crosses again"});
    }
    TouchCalibration calibration;
    calibration.table = in_table_frame(found.fit.model);
    if (!calibration.table) {
        return refused({"touches.off_table", "the light of the picture's middle does not meet the table"});
    }
    const Covariance covariance = found.scatter * found.scatter * inverse_of(found.fit.information());
    const std::vector<ZonePlace> places = zone_places(found.fit.model, found.fit.middle, zone);
    calibration.uncertainty = picture_uncertainty(places, covariance);
    calibration.uncertainty.shares = picture_shares(places, covariance);
    calibration.zone = by_place(places, calibration.uncertainty.each_m);
    calibration.hidden_error_m = hidden_error_of(without(touches, found.wrong), fit_setup, found.fit, zone);
    calibration.prior_shares = prior_shares(found.fit);
    calibration.residuals = residuals_of(touches, found.wrong, fit_setup, found.fit.model);
    const auto highest = std::max_element(
        touches.begin(), touches.end(), [](const Touch& a, const Touch& b) { return a.block_m < b.block_m; });
    calibration.boards = boards_of(found.fit.model, covariance, highest->block_m);
    judge(calibration, crosses, found, row_names(found.wrong));
    if (const auto touch =
            found.agreement == Agreement::All ? doubtful_one(touches, fit_setup, found.fit) : std::nullopt) {
        doubt(calibration, *touch);
    }
    calibration.reason.sentence += in_words(calibration.boards);
    return calibration;
}

} // namespace frustumscreen::calibration
