/// Values to try, evenly spread on a logarithmic axis.
///
/// Threads  pure; any.
#pragma once

#include <vector>

namespace frustumscreen::bench {

/// From `low` to `high`, both included, about `per_decade` values per decade.
[[nodiscard]] std::vector<double> sweep(double low, double high, int per_decade);

} // namespace frustumscreen::bench
