/// Names from a file as one printable line each, made unique by a number.
///
/// Threads  values; any.
#pragma once

#include "firmware_host/base/printable.h"
#include "firmware_host/base/trimmed.h"

#include <fmt/format.h>

#include <set>
#include <string>

namespace frustumscreen::bake {

class UniqueNames {
public:
    /// `name` as the file has it; without one, "KIND INDEX". A name that was there before gets " 2", " 3", ...
    [[nodiscard]] std::string of(const std::string& name, const char* kind, std::size_t index) {
        constexpr std::size_t longest = 80;
        std::string given(trimmed(printable(name, longest)));
        if (given.empty()) {
            given = fmt::format("{} {}", kind, index);
        }
        std::string unique = given;
        for (std::size_t number = 2; !taken_.insert(unique).second; ++number) {
            unique = fmt::format("{} {}", given, number);
        }
        return unique;
    }

private:
    std::set<std::string> taken_;
};

} // namespace frustumscreen::bake
