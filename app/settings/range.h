/// Allowed values of a number, both ends included, and their wording.
///
/// Threads  pure; any.
#pragma once

#include <fmt/format.h>

#include <string>
#include <string_view>

namespace frustumscreen::settings {

struct Range {
    double low = 0.0;
    double high = 0.0;
    std::string_view unit; ///< a plural word, or empty
};

[[nodiscard]] inline std::string words_of(const Range& range) {
    return fmt::format("{} to {}{}{}", range.low, range.high, range.unit.empty() ? "" : " ", range.unit);
}

} // namespace frustumscreen::settings
