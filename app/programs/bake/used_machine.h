/// The time and memory that this process has used so far.
///
/// Threads  any.
#pragma once

#include <cstdint>

namespace frustumscreen::programs {

struct UsedMachine {
    double processor_s = 0.0;       ///< of all cores together
    std::uint64_t memory_bytes = 0; ///< peak; 0 where the system does not report it
};
[[nodiscard]] UsedMachine used_machine();

} // namespace frustumscreen::programs
