/// The machine's name in a network: on the appliance `frustumscreen-` and six digits that differ from machine to
/// machine.
///
/// Threads  any.
#pragma once

#include <unistd.h>

#include <array>
#include <string>

namespace frustumscreen {

/// Empty if the system does not give it.
[[nodiscard]] inline std::string host_name() {
    std::array<char, 256> name{};
    return ::gethostname(name.data(), name.size() - 1) == 0 ? std::string(name.data()) : std::string();
}

} // namespace frustumscreen
