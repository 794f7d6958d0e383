/// Finds the touches that agree with each other, and the touches that do not.
///
/// Method   Finds the smallest set of touches without which all others agree: leaves out each touch, each
///          pair, each triple. Where that is too many fits, it adds one touch to the sets found so far. A
///          touch agrees if its leave-one-out residual is within what the noise explains.
/// Threads  pure; any.
#pragma once

#include "app/calibration/fit.h"

namespace frustumscreen::calibration {

enum class Agreement {
    All,       ///< all, within the noise
    Scattered, ///< all, with up to twice the expected noise
    Without,   ///< all except `wrong`
    Exchanged, ///< all, once the two touches of `wrong` change places
    None,
};

struct Agreed {
    Agreement agreement = Agreement::None;
    std::vector<std::size_t>
        wrong;            ///< touches to repeat, ascending; the union if several sets explain the misfit
    double scatter = 1.0; ///< noise found over noise expected, at least 1
};
struct AgreeingTouches : Agreed {
    Fit fit; ///< to the touches that agree
};

/// 99.9 % quantile of chi squared with `freedom` degrees of freedom.
[[nodiscard]] double chi2_limit(int freedom);

/// Fits all touches from every start and returns the fit with the least chi squared.
[[nodiscard]] Fit best_fit(std::span<const Touch> touches, const FitSetup& setup,
                           std::span<const TouchModel> starts);
[[nodiscard]] AgreeingTouches find_agreement(std::span<const Touch> touches, const FitSetup& setup,
                                             std::span<const TouchModel> starts);

} // namespace frustumscreen::calibration
