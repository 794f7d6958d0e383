#include "app/bench/stability/sweep.h"

#include <cmath>

namespace frustumscreen::bench {

std::vector<double> sweep(double low, double high, int per_decade) {
    const auto count = static_cast<int>(std::lround(per_decade * std::log10(high / low)));
    std::vector<double> values;
    values.reserve(static_cast<std::size_t>(count) + 1);
    for (int k = 0; k <= count; ++k) {
        values.push_back(low * std::pow(high / low, static_cast<double>(k) / count));
    }
    return values;
}

} // namespace frustumscreen::bench
