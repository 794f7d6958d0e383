/// Waits for what another thread or process does; asserts no duration.
#pragma once

#include <chrono>
#include <thread>

namespace frustumscreen {

/// Tests `holds` every millisecond until it is true; false if it is not within `limit`, which only a hang reaches.
template <typename Holds>
[[nodiscard]] bool comes_true(const Holds& holds, std::chrono::nanoseconds limit = std::chrono::seconds(60)) {
    for (const auto give_up = std::chrono::steady_clock::now() + limit;
         std::chrono::steady_clock::now() < give_up;) {
        if (holds()) {
            return true;
        }
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    return holds();
}

} // namespace frustumscreen
