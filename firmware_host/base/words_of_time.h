/// A duration in spoken form: '40 s', '4 min', '2 h 5 min'.
///
/// Threads  pure; any.
#pragma once

#include <fmt/format.h>

#include <cmath>
#include <string>

namespace frustumscreen {

[[nodiscard]] inline std::string words_of_time(double seconds) {
    if (seconds < 99.5) {
        return fmt::format("{:.0f} s", std::fmax(seconds, 0.0));
    }
    const int minutes = static_cast<int>(std::lround(std::fmin(seconds, 1e8) / 60.0));
    return minutes < 120 ? fmt::format("{} min", minutes)
                         : fmt::format("{} h {} min", minutes / 60, minutes % 60);
}

} // namespace frustumscreen
