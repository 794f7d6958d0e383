/// Number of the machine's cores that this process may use, as limited by its scheduler, a container or
/// `taskset`.
///
/// Threads  any.
#pragma once

#include <sched.h>

#include <algorithm>
#include <thread>

namespace frustumscreen {

/// At least 1.
[[nodiscard]] inline unsigned usable_cores() {
    cpu_set_t set;
    // Fails on machines with more than 1024.
    const bool is_known = ::sched_getaffinity(0, sizeof(set), &set) == 0;
    return std::max(1U,
                    is_known ? static_cast<unsigned>(CPU_COUNT(&set)) : std::thread::hardware_concurrency());
}

} // namespace frustumscreen
