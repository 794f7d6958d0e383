/// What a test tells the plugin faulty_card.cpp, whose symbol `faulty_card` this is.
#pragma once

#include <atomic>

namespace frustumscreen::testing {

struct FaultyCard {
    std::atomic<int> underruns{0};       ///< to happen still
    std::atomic<int> suspensions{0};     ///< to happen still
    std::atomic<int> resumes_refused{0}; ///< for now, with EAGAIN
    std::atomic<unsigned> period{0};     ///< frames, which it insists on when it is opened; 0: any
    std::atomic<unsigned> buffer{0};     ///< the same
    std::atomic<bool> gone{false};
    std::atomic<int> opened{0};
    std::atomic<int> resumed{0};
    std::atomic<long> frames{0}; ///< taken so far
};

} // namespace frustumscreen::testing
