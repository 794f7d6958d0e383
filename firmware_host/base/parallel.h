/// Distributes offline work over the usable cores. Never used on the kiosk's render path.
///
/// Threads  the caller's and one more for each further core; returns when all are done.
#pragma once

#include "firmware_host/base/usable_cores.h"

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <thread>
#include <vector>

namespace frustumscreen {

/// Calls body(begin, end) for blocks of at most `block` that cover [0, count), in any order, on all cores.
/// The blocks do not depend on the number of cores, so a body that keys its work on `begin` is deterministic.
template <typename Body> void parallel_for(std::size_t count, std::size_t block, const Body& body) {
    std::atomic<std::size_t> next{0};
    const auto work = [&] {
        for (std::size_t begin = next.fetch_add(block); begin < count; begin = next.fetch_add(block)) {
            body(begin, std::min(count, begin + block));
        }
    };
    std::vector<std::jthread> helpers;
    for (unsigned core = 1; core < usable_cores(); ++core) {
        helpers.emplace_back(work);
    }
    work();
}

} // namespace frustumscreen
