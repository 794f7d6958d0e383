// Counts the flashes of a picture, from the definition alone.
//
// WCAG 2.2, success criterion 2.3.1 and 'general flash': a flash is a pair of opposing changes in relative
// luminance, an increase and then a decrease or the other way round, of 10 % or more of the maximum each,
// where the darker image is below 0.80; more than three within any one second are a failure. ITU-R BT.1702
// counts likewise. The exceptions for small areas are not used: one pixel counts as the whole picture.
#pragma once

#include "firmware_host/base/time.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

namespace frustumscreen::exhibit {

struct Luminance {
    MonotonicTime time;
    double value = 0.0; ///< relative, 0..1
};

/// Flashes in these samples. A change lasts as long as the luminance goes in one direction; less than 10 % in
/// the other direction does not end it.
inline int flashes_in(std::span<const Luminance> samples) {
    constexpr double min_change = 0.10 - 1e-9;
    std::vector<double> turns; // luminances at which changes begin and end
    double low = samples.empty() ? 0.0 : samples.front().value;
    double high = low;
    int direction = 0; // nothing has changed yet
    for (const Luminance& sample : samples) {
        const double value = sample.value;
        low = std::min(low, value);
        high = std::max(high, value);
        if (direction <= 0 && value - low >= min_change) {
            turns.push_back(low);
            direction = 1;
            high = value;
        } else if (direction >= 0 && high - value >= min_change) {
            turns.push_back(high);
            direction = -1;
            low = value;
        } else if (direction > 0) {
            low = high; // the way back is counted from the top
        } else if (direction < 0) {
            high = low;
        }
    }
    turns.push_back(direction > 0 ? high : low);
    int flashes = 0;
    for (std::size_t k = 0; k + 2 < turns.size(); ++k) {
        if (std::min({turns[k], turns[k + 1], turns[k + 2]}) < 0.80) {
            ++flashes;
            ++k; // the second change is used up
        }
    }
    return flashes;
}

/// The most within any one second. Samples in ascending time.
inline int max_flashes_per_second(std::span<const Luminance> samples) {
    int most = 0;
    std::size_t end = 0;
    for (std::size_t begin = 0; begin < samples.size(); ++begin) {
        while (end < samples.size() && samples[end].time - samples[begin].time <= std::chrono::seconds(1)) {
            ++end;
        }
        most = std::max(most, flashes_in(samples.subspan(begin, end - begin)));
    }
    return most;
}

} // namespace frustumscreen::exhibit
