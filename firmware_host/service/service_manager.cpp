#include "firmware_host/service/service_manager.h"

#include <fmt/format.h>
#include <systemd/sd-daemon.h>

#include <cstdlib>

namespace frustumscreen::service {

ServiceManager::ServiceManager() : listens_(std::getenv("NOTIFY_SOCKET") != nullptr) {
    std::uint64_t interval_us = 0;
    if (::sd_watchdog_enabled(0, &interval_us) > 0) {
        watchdog_interval_ = std::chrono::microseconds(interval_us);
    }
}

void ServiceManager::still_starting(Nanoseconds at_most) const {
    const auto us = std::chrono::duration_cast<std::chrono::microseconds>(at_most).count();
    ::sd_notify(0, fmt::format("EXTEND_TIMEOUT_USEC={}", us).c_str());
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
    constexpr std::string_view name = "STATUS=";
    // A whole sentence, and the terminating zero.
    std::array<char, name.size() + Sentence::longest + 1> message{};
    const auto end = fmt::format_to_n(message.data(), message.size() - 1, "{}{}", name, sentence.view()).out;
    std::replace(message.data(), end, '\n', ' '); // a line break would begin another message
    ::sd_notify(0, message.data());
}

} // namespace frustumscreen::service
