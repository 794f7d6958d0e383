/// The machine's name in a network: on the appliance frustumscreen- and six digits, of which no two are the same.
#pragma once

#include <unistd.h>

#include <array>
#include <string>

namespace frustumscreen {

/// Empty: it cannot be had.
[[nodiscard]] inline std::string host_name() {
    std::array<char, 256> name{};
    return ::gethostname(name.data(), name.size() - 1) == 0 ? std::string(name.data()) : std::string();
}

} // namespace frustumscreen
