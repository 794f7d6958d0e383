#include "firmware_host/panel/key_levels.h"

#include <algorithm>
#include <cstring>

namespace frustumscreen::panel {

bool KeyLevels::take(std::span<const std::byte> bytes) {
    bool dropped = false;
    while (!bytes.empty()) {
        const std::size_t more = std::min(bytes.size(), part_.size() - part_bytes_);
        std::copy_n(bytes.begin(), more, part_.begin() + static_cast<std::ptrdiff_t>(part_bytes_));
        part_bytes_ += more;
        bytes = bytes.subspan(more);
        if (part_bytes_ == part_.size()) {
            input_event event{};
            std::memcpy(&event, part_.data(), sizeof event);
            part_bytes_ = 0;
            dropped = take(event) || dropped;
        }
    }
    return dropped;
}

bool KeyLevels::take(const input_event& event) {
    if (event.type == EV_SYN) {
        dropped_ = event.code == SYN_DROPPED || (dropped_ && event.code != SYN_REPORT);
        return event.code == SYN_DROPPED;
    }
    if (event.type == EV_KEY && !dropped_) {
        for (std::size_t k = 0; k < codes_.size(); ++k) {
            if (codes_[k] == event.code) {
                down_[k] = event.value != 0 ? 1 : 0; // 2: the key repeats
            }
        }
    }
    return false;
}

void KeyLevels::set(std::span<const std::byte> keys) {
    for (std::size_t k = 0; k < codes_.size(); ++k) {
        const std::size_t byte = codes_[k] / 8U;
        const auto bit = static_cast<std::byte>(1U << (codes_[k] % 8U));
        down_[k] = byte < keys.size() && (keys[byte] & bit) != std::byte{0} ? 1 : 0;
    }
}

} // namespace frustumscreen::panel
