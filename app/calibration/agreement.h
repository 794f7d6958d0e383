/// Which touches agree with each other, and which do not.
///
/// Method   the fewest touches without which all others agree, found by leaving out each, each two, each three of them; where that would be too
///          many to try, one more on top of those found. A touch agrees if its residual, left out, is within what the noise explains.
/// Threads  pure; any.
#pragma once

#include "app/calibration/fit.h"

namespace frustumscreen {

enum class Agreement {
    All,       ///< within the noise
    Scattered, ///< all alike, but with up to twice the noise
    Without,   ///< all but `wrong`
    Exchanged, ///< all, if the two of `wrong` change places
    None,
};

struct Agreed {
    Agreement agreement = Agreement::None;
    std::vector<std::size_t> wrong; ///< ascending; those to do again. Where several choices explain it, all
    double scatter = 1.0;           ///< noise found over noise expected, at least 1
};
struct AgreeingTouches : Agreed {
    Fit fit; ///< of those that agree
};

/// Of chi squared, one in a thousand is beyond.
[[nodiscard]] double chi2_limit(int freedom);

/// The best fit of all touches, from every start.
[[nodiscard]] Fit best_fit(std::span<const Touch> touches, const FitSetup& setup,
                           std::span<const TouchModel> starts);
[[nodiscard]] AgreeingTouches find_agreement(std::span<const Touch> touches, const FitSetup& setup,
                                             std::span<const TouchModel> starts);

} // namespace frustumscreen
