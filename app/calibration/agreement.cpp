#include "app/calibration/agreement.h"

#include "app/calibration/dense_solvers.h"
#include "app/calibration/reliability.h"
#include "app/calibration/starts.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace frustumscreen::calibration {

namespace {

/// Largest number of sets that are tried at once; beyond it, touches are added one by one.
constexpr std::size_t max_choices = 1000;
/// At most a fifth of the touches counts as wrong: fewer others cannot tell which ones are.
constexpr std::size_t wrong_of = 5;
constexpr double max_scatter = 2.0;
/// A rough fit is refined if its chi squared is below this multiple of the limit.
constexpr double worth_a_fit = 100.0;
/// Sets whose chi squared differs by less than this explain the touches equally well.
constexpr double alike = 6.0;

using Choice = std::vector<std::size_t>;

bool agrees(std::span<const Touch> touches, const FitSetup& setup, const Fit& fit, double scatter) {
    const double scale = scatter * scatter;
    if (!(fit.chi2 / scale < chi2_limit(fit.freedom))) {
        return false;
    }
    const Covariance covariance = inverse_of(fit.information());
    const WhitenedTouches whitened = whitened_touches(touches, setup, fit.model, fit.middle);
    for (std::size_t k = 0; k < touches.size(); ++k) {
        if (left_out_chi2(whitened.rows[k], whitened.residuals[k], covariance) / scale > touch_chi2_limit) {
            return false;
        }
    }
    return true;
}

std::vector<Choice> choices_of(std::size_t touches, std::size_t wrong) {
    std::vector<Choice> choices;
    Choice choice(wrong);
    std::iota(choice.begin(), choice.end(), std::size_t{0});
    while (true) {
        choices.push_back(choice);
        std::size_t k = wrong;
        while (k > 0 && choice[k - 1] == touches - wrong + k - 1) {
            --k;
        }
        if (k == 0 || choices.size() > max_choices) {
            return choices;
        }
        ++choice[k - 1];
        for (std::size_t j = k; j < wrong; ++j) {
            choice[j] = choice[j - 1] + 1;
        }
    }
}

/// `base` plus each one of the other touches.
std::vector<Choice> one_more(const Choice& base, std::size_t touches) {
    std::vector<Choice> choices;
    for (std::size_t k = 0; k < touches; ++k) {
        if (std::find(base.begin(), base.end(), k) == base.end()) {
            choices.push_back(base);
            choices.back().push_back(k);
            std::sort(choices.back().begin(), choices.back().end());
        }
    }
    return choices;
}

struct Tried {
    Choice choice;
    Fit fit;
    bool agrees = false;
};

/// Fits without `choice` from two starts: the robust fit, and a start without those touches, in case they
/// bent the robust fit.
Tried tried_from(std::span<const Touch> touches, const FitSetup& setup, const TouchModel& start,
                 Choice choice) {
    Touches kept;
    FitSetup kept_setup = setup;
    kept_setup.upright.clear();
    for (std::size_t k = 0; k < touches.size(); ++k) {
        if (std::find(choice.begin(), choice.end(), k) == choice.end()) {
            kept.push_back(touches[k]);
            kept_setup.upright.push_back(setup.upright.empty() || setup.upright[k]);
        }
    }
    const geometry::Pinhole& p = start.pinhole;
    const TouchModel own = start_with(kept, p.width, p.height, std::sqrt(p.fx * p.fy));
    Fit rough = fit_roughly(kept, kept_setup, start);
    Fit other = fit_roughly(kept, kept_setup, own);
    rough = other.chi2 < rough.chi2 ? std::move(other) : std::move(rough);
    Tried tried{std::move(choice), std::move(rough)};
    if (tried.fit.chi2 < worth_a_fit * chi2_limit(tried.fit.freedom)) {
        tried.fit = fit_touches(kept, {}, kept_setup, tried.fit.model);
        tried.agrees = agrees(kept, kept_setup, tried.fit, 1.0);
    }
    return tried;
}

bool better(const Tried& a, const Tried& b) {
    return a.fit.chi2 < b.fit.chi2;
}

/// Fits without each of the sets, the best first.
std::vector<Tried> try_without(std::span<const Touch> touches, const FitSetup& setup, const TouchModel& start,
                               std::vector<Choice> choices) {
    std::vector<Tried> tried;
    for (Choice& choice : choices) {
        tried.push_back(tried_from(touches, setup, start, std::move(choice)));
    }
    std::sort(tried.begin(), tried.end(), better);
    return tried;
}

/// Fits with each pair exchanged, the best first.
std::vector<Tried> try_exchanged(std::span<const Touch> touches, const FitSetup& setup,
                                 const TouchModel& start) {
    std::vector<Tried> tried;
    for (Choice& pair : choices_of(touches.size(), 2)) {
        Touches turned(touches.begin(), touches.end());
        std::swap(turned[pair[0]].tracker_from_sensor, turned[pair[1]].tracker_from_sensor);
        FitSetup turned_setup = setup;
        if (!setup.upright.empty()) { // it goes with the pose
            turned_setup.upright[pair[0]] = setup.upright[pair[1]];
            turned_setup.upright[pair[1]] = setup.upright[pair[0]];
        }
        tried.push_back(tried_from(turned, turned_setup, start, {}));
        tried.back().choice = std::move(pair);
    }
    std::sort(tried.begin(), tried.end(), better);
    return tried;
}

/// The best set that explains the touches, joined with those that explain them equally well. Nothing if the
/// union is more than a third of the touches.
std::optional<AgreeingTouches> explained(std::vector<Tried> tried, Agreement agreement, std::size_t touches) {
    if (tried.empty() || !tried[0].agrees) {
        return std::nullopt;
    }
    Choice wrong;
    for (const Tried& one : tried) {
        if (one.agrees && one.fit.chi2 < tried[0].fit.chi2 + alike) {
            wrong.insert(wrong.end(), one.choice.begin(), one.choice.end());
        }
    }
    std::sort(wrong.begin(), wrong.end());
    wrong.erase(std::unique(wrong.begin(), wrong.end()), wrong.end());
    if (3 * wrong.size() > touches) {
        return std::nullopt;
    }
    return AgreeingTouches{{agreement, std::move(wrong)}, std::move(tried[0].fit)};
}

} // namespace

// Wilson and Hilferty, The distribution of chi-square, 1931.
double chi2_limit(int freedom) {
    const double n = std::max(1, freedom);
    const double root = 1.0 - 2.0 / (9.0 * n) + 3.09 * std::sqrt(2.0 / (9.0 * n));
    return n * root * root * root;
}

Fit best_fit(std::span<const Touch> touches, const FitSetup& setup, std::span<const TouchModel> starts) {
    std::optional<Fit> best;
    for (const TouchModel& start : starts) {
        Fit fit = fit_touches(touches, {}, setup, start);
        if (!best || fit.chi2 < best->chi2) {
            best = std::move(fit);
        }
    }
    return *best;
}

AgreeingTouches find_agreement(std::span<const Touch> touches, const FitSetup& setup,
                               std::span<const TouchModel> starts) {
    Fit all = best_fit(touches, setup, starts);
    if (agrees(touches, setup, all, 1.0)) {
        return {{Agreement::All, {}}, std::move(all)};
    }
    std::optional<Fit> robust;
    for (const TouchModel& start : starts) {
        Fit fit = fit_robustly(touches, setup, start);
        if (!robust || fit.chi2 < robust->chi2) {
            robust = std::move(fit);
        }
    }
    Choice best;
    for (std::size_t wrong = 1; wrong <= touches.size() / wrong_of; ++wrong) {
        std::vector<Choice> choices = choices_of(touches.size(), wrong);
        if (choices.size() > max_choices) {
            choices = one_more(best, touches.size());
        }
        std::vector<Tried> tried = try_without(touches, setup, robust->model, std::move(choices));
        best = tried[0].choice;
        if (auto found = explained(std::move(tried), Agreement::Without, touches.size())) {
            return *found;
        }
        if (wrong == 1) {
            if (auto found = explained(try_exchanged(touches, setup, robust->model), Agreement::Exchanged,
                                       touches.size())) {
                return *found;
            }
        }
    }
    const double scatter = std::sqrt(all.chi2 / std::max(1, all.freedom));
    if (scatter < max_scatter && agrees(touches, setup, all, scatter)) {
        return {{Agreement::Scattered, {}, scatter}, std::move(all)};
    }
    return {{}, std::move(all)};
}

} // namespace frustumscreen::calibration
