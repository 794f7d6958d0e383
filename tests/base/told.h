/// An error as a program prints it, for tests that look for its id and for the names and numbers in its sentence.
#pragma once

#include "firmware_host/base/result.h"

#include <fmt/format.h>

#include <string>

namespace frustumscreen::test {

/// `sentence [id]`.
[[nodiscard]] inline std::string told(const Error& error) {
    return fmt::format("{} [{}]", error.message, error.id.view());
}

} // namespace frustumscreen::test
