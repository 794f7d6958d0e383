/// Controls of the plugin faulty_card.cpp, accessed through its symbol `faulty_card`.
#pragma once

#include <atomic>

namespace frustumscreen::testing {

struct FaultyCard {
    std::atomic<int> underruns{0};       ///< still pending
    std::atomic<int> suspensions{0};     ///< still pending
    std::atomic<int> resumes_refused{0}; ///< still pending, with EAGAIN
    std::atomic<unsigned> period{0};     ///< frames, required when the device is opened; 0: any
    std::atomic<unsigned> buffer{0};     ///< likewise
    std::atomic<bool> gone{false};
    std::atomic<int> opened{0};
    std::atomic<int> resumed{0};
    std::atomic<long> frames{0}; ///< consumed so far
};

} // namespace frustumscreen::testing
