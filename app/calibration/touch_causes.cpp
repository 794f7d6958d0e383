#include "app/calibration/touch_causes.h"

#include "app/calibration/check_touches.h"
#include "app/calibration/moved_meanwhile.h"
#include "app/calibration/near_metal.h"
#include "app/calibration/starts.h"
#include "app/calibration/upright_touches.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace frustumscreen::calibration {

namespace {

/// The touches with one mistake undone, and a clause that names the mistake.
struct Mistake {
    Touches undone;
    MessageId id;
    std::string_view what;
};

/// Mistakes that affect all touches at once. find_agreement finds a single wrong touch, or two exchanged
/// ones.
std::vector<Mistake> mistakes_in(std::span<const Touch> touches, int width) {
    const std::size_t count = touches.size();
    const auto with_pose_of = [&](const auto& number_of) {
        Touches undone(touches.begin(), touches.end());
        for (std::size_t k = 0; k < count; ++k) {
            undone[k].tracker_from_sensor = touches[number_of(k)].tracker_from_sensor;
        }
        return undone;
    };
    Touches mirrored(touches.begin(), touches.end());
    for (Touch& touch : mirrored) {
        touch.pixel.x = width - touch.pixel.x;
    }
    return {
        {std::move(mirrored), "touches.mirrored",
         "the projector's picture is mirrored: switch its ceiling or rear projection off, and touch the "
         "crosses again"},
        {with_pose_of([&](std::size_t k) { return (k + count - 1) % count; }), "touches.one_left_out",
         "each touch belongs to the next cross: one was left out, or the list begins too late"},
        {with_pose_of([&](std::size_t k) { return (k + 1) % count; }), "touches.one_twice",
         "each touch belongs to the cross before: one was taken twice, or the list begins too early"},
        {with_pose_of([&](std::size_t k) { return count - 1 - k; }), "touches.reversed",
         "the crosses were touched in the opposite order"},
    };
}

/// Least decrease of chi squared by an unknown of a disturbance, over what is left by each degree of freedom: the F ratio.
/// docs/calibration.md says how rarely right touches reach it.
constexpr double min_ratio = 7.0;
/// Smallest disturbance that is named, in metres: five times the noise of a report. A smaller one is within what the verdict allows for.
constexpr double min_size_m = 1.5e-3;
/// Least decrease of the cost below that of wrong touches: one of them is the more usual fault.
constexpr double apart = 3.0;
/// Penalty in chi squared per unknown of an explanation (Akaike 1974).
constexpr double unknown_cost = 2.0;
/// A wrong touch is left out with its three equations, and with its number.
constexpr int wrong_unknowns = 4;

double cost_of(double chi2, int unknowns) {
    return chi2 + unknown_cost * unknowns;
}

bool explains(const Disturbance& found, const Fit& all, double best_cost) {
    const double noise = std::fmax(1.0, found.chi2 / found.freedom);
    const double ratio = (all.chi2 - found.chi2) / (found.unknowns - 1) / noise;
    return found.size_m > min_size_m && ratio > min_ratio && found.chi2 < chi2_limit(found.freedom) &&
           cost_of(found.chi2, found.unknowns) < best_cost;
}

/// The cost of the explanation that some touches are wrong and nothing else is.
double cost_of_wrong_ones(const AgreeingTouches& found, const Fit& all) {
    if (found.agreement == Agreement::All || found.agreement == Agreement::Without) {
        return cost_of(found.fit.chi2, wrong_unknowns * static_cast<int>(found.wrong.size()));
    }
    return all.chi2;
}

} // namespace

std::optional<VerdictReason> mistake_in(std::span<const Touch> touches, const FitSetup& setup, int width,
                                        int height) {
    for (const Mistake& mistake : mistakes_in(touches, width)) {
        if (refusal_of(mistake.undone, width, height)) {
            continue;
        }
        const std::vector<TouchModel> starts = starting_models(mistake.undone, width, height);
        FitSetup undone = setup;
        undone.upright = upright_ones(mistake.undone, starts[0].table_up);
        const Fit fit = best_fit(mistake.undone, undone, starts);
        if (fit.chi2 < chi2_limit(fit.freedom)) {
            return VerdictReason{
                mistake.id,
                fmt::format("the touches contradict each other as given, and agree if {}", mistake.what)};
        }
    }
    return std::nullopt;
}

std::optional<VerdictReason> disturbance_of(std::span<const Touch> touches, const FitSetup& setup,
                                            const AgreeingTouches& found) {
    const FittedTouches all = fitted(touches, setup, found.fit.model);
    const double best_cost = cost_of_wrong_ones(found, all.fit) - apart;
    const std::optional<Disturbance> moved = moved_meanwhile(touches, setup, all);
    const std::optional<Disturbance> metal = near_metal(touches, setup, all);
    const bool is_moved = moved && explains(*moved, all.fit, best_cost);
    const bool is_metal = metal && explains(*metal, all.fit, best_cost);
    if (is_moved && !(is_metal && metal->chi2 < moved->chi2)) {
        return VerdictReason{
            "touches.moved",
            fmt::format(
                "the touches agree if the projector or the tracker's source moved by about {:.0f} mm at "
                "about touch {}: fix both, and touch the crosses again",
                1e3 * moved->size_m, moved->touch + 1)};
    }
    if (is_metal) {
        return VerdictReason{
            "touches.metal",
            fmt::format(
                "the touches agree if metal bends the tracker's field, most of all near touch {}, there by "
                "about {:.0f} mm: take it away, and touch the crosses again",
                metal->touch + 1, 1e3 * metal->size_m)};
    }
    return std::nullopt;
}

} // namespace frustumscreen::calibration
