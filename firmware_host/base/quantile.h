/// Quantiles of measured values.
///
/// Threads  pure; any. `quantile_in` allocates nothing.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

namespace frustumscreen {

/// The smallest value with at least share * n values at or below it; zero if there are no values. Reorders
/// the values.
template <typename Number> [[nodiscard]] double quantile_in(std::span<Number> values, double share) {
    if (values.empty()) {
        return 0.0;
    }
    const double rank = std::ceil(share * static_cast<double>(values.size()));
    const auto place = values.begin() + static_cast<std::ptrdiff_t>(
                                            std::clamp(rank, 1.0, static_cast<double>(values.size())) - 1.0);
    std::nth_element(values.begin(), place, values.end());
    return static_cast<double>(*place);
}
/// As `quantile_in`, on a copy of the values.
[[nodiscard]] inline double quantile(std::vector<double> values, double share) {
    return quantile_in(std::span(values), share);
}

} // namespace frustumscreen
