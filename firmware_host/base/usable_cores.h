/// How many of the machine's cores this process may use: those that its scheduler, a container or `taskset` left it.
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
    const bool is_known = ::sched_getaffinity(0, sizeof(set), &set) == 0; // not on machines of more than 1024
    return std::max(1U,
                    is_known ? static_cast<unsigned>(CPU_COUNT(&set)) : std::thread::hardware_concurrency());
}

} // namespace frustumscreen
