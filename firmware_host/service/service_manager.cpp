#include "firmware_host/service/service_manager.h"

#include <fmt/format.h>
#include <systemd/sd-daemon.h>

namespace frustumscreen {

ServiceManager::ServiceManager() {
    std::uint64_t interval_us = 0;
    if (::sd_watchdog_enabled(0, &interval_us) > 0) {
        watchdog_interval_ = std::chrono::microseconds(interval_us);
    }
}

void ServiceManager::ready() const {
    ::sd_notify(0, "READY=1");
}

void ServiceManager::feed_watchdog() const {
    ::sd_notify(0, "WATCHDOG=1");
}

void ServiceManager::stopping() const {
    ::sd_notify(0, "STOPPING=1");
}

void ServiceManager::status(const Sentence& sentence) {
    if (sentence == status_) {
        return;
    }
    status_ = sentence;
    std::array<char, 512> message{};
    const auto end = fmt::format_to_n(message.data(), message.size() - 1, "STATUS={}", sentence.view()).out;
    std::replace(message.data(), end, '\n', ' '); // a line break would begin another message
    ::sd_notify(0, message.data());
}

} // namespace frustumscreen
