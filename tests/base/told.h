/// An error as a program prints it, for tests that look for its id and for the names and numbers in its sentence.
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

/// Whether every part stands in what is told: the id, and the names and numbers that it must tell.
[[nodiscard]] inline bool tells(std::string_view told, std::initializer_list<std::string_view> parts) {
    return std::all_of(parts.begin(), parts.end(),
                       [&](std::string_view part) { return told.find(part) != std::string_view::npos; });
}

} // namespace frustumscreen::test
