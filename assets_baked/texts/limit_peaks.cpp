#include "assets_baked/texts/limit_peaks.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <deque>

namespace frustumscreen::texts {

namespace {

/// For each value, the minimum of the values within `reach` elements.
std::vector<float> min_around(std::span<const float> values, std::size_t reach) {
    std::vector<float> least(values.size());
    std::deque<std::size_t> rising; // indices in the window, with increasing values
    std::size_t next = 0;
    for (std::size_t k = 0; k < values.size(); ++k) {
        for (; next < std::min(values.size(), k + reach + 1); ++next) {
            while (!rising.empty() && values[rising.back()] >= values[next]) {
                rising.pop_back();
            }
            rising.push_back(next);
        }
        while (rising.front() + reach < k) {
            rising.pop_front();
        }
        least[k] = values[rising.front()];
    }
    return least;
}

/// For each value, the mean of the values within `reach` elements; the end values continue beyond the ends.
std::vector<float> mean_around(std::span<const float> values, std::size_t reach) {
    const auto at = [&](std::size_t shifted) { // by `reach`
        return static_cast<double>(values[std::min(std::max(shifted, reach) - reach, values.size() - 1)]);
    };
    std::vector<float> mean(values.size());
    const std::size_t width = 2 * reach + 1;
    double sum = 0.0;
    for (std::size_t k = 0; k < width; ++k) {
        sum += at(k);
    }
    for (std::size_t k = 0; k < values.size(); ++k) {
        mean[k] = static_cast<float>(sum / static_cast<double>(width));
        sum += at(k + width) - at(k);
    }
    return mean;
}

} // namespace

std::vector<float> limit_peaks(std::span<const float> samples, int rate_hz, float most) {
    std::vector<float> limited(samples.begin(), samples.end());
    if (samples.empty()) {
        return limited;
    }
    std::transform(samples.begin(), samples.end(), limited.begin(),
                   [&](float sample) { return most / std::max(most, std::abs(sample)); });
    const std::size_t reach = static_cast<std::size_t>(rate_hz) / 200;
    // Each gain averaged is a minimum that includes the peak's own, so the mean never exceeds the gain that
    // the peak needs.
    const std::vector<float> gains = mean_around(min_around(limited, reach), reach);
    std::transform(samples.begin(), samples.end(), gains.begin(), limited.begin(),
                   [&](float sample, float gain) { return std::clamp(sample * gain, -most, most); });
    return limited;
}

} // namespace frustumscreen::texts
