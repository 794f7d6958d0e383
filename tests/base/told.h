/// An error as printed by a program, for tests that look for its id and for names and numbers in its
/// sentence.
#pragma once

#include "firmware_host/base/result.h"

#include <fmt/format.h>

#include <algorithm>
#include <initializer_list>
#include <string>
#include <string_view>

namespace frustumscreen::test {

/// `sentence [id]`.
[[nodiscard]] inline std::string told(const Error& error) {
    return fmt::format("{} [{}]", error.message, error.id.view());
}

/// Whether `told` contains every part: the id, and the required names and numbers.
[[nodiscard]] inline bool tells(std::string_view told, std::initializer_list<std::string_view> parts) {
    return std::all_of(parts.begin(), parts.end(),
                       [&](std::string_view part) { return told.find(part) != std::string_view::npos; });
}

} // namespace frustumscreen::test
