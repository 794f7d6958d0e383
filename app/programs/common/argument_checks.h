/// Checks of arguments that several programs share, with a sentence for the user.
///
/// Threads  any.
#pragma once

#include "app/programs/common/command_line.h"
#include "app/scene/scene_plan.h"

#include <fmt/format.h>

#include <charconv>
#include <string>

namespace frustumscreen::programs {

/// Checks only the form of the word; the existing levels are known from the packs.
[[nodiscard]] inline ArgumentCheck is_technique_word() {
    const auto check = [](const std::string& text) {
        return scene::is_technique(text)
                   ? std::string()
                   : fmt::format("unknown technique '{}'; allowed are auto, finest, level0, level1, ..., "
                                 "relief, relief96, relief192, ..., relief-gpu, relief96-gpu, ...",
                                 text);
    };
    return {check, ""};
}

[[nodiscard]] inline ArgumentCheck seconds_between(double low, double high) {
    const auto check = [low, high](const std::string& text) {
        double seconds = 0.0;
        const char* const end = text.data() + text.size();
        const std::from_chars_result read = std::from_chars(text.data(), end, seconds);
        const bool well = read.ec == std::errc{} && read.ptr == end && seconds >= low && seconds <= high;
        return well ? std::string()
                    : fmt::format("'{}' is not allowed; allowed are {} to {:.0f} seconds, such as 8 or 0.5",
                                  text, low, high);
    };
    return {check, fmt::format("in [{} - {:.0f}]", low, high)};
}

} // namespace frustumscreen::programs
