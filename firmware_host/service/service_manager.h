/// Reports the exhibit's state to the service manager: sd_notify(3). Without a service manager it does
/// nothing.
///
/// Threads  one caller; a call sends one datagram.
/// Errors   none: without a listener a message is lost.
#pragma once

#include "firmware_host/base/sentence.h"
#include "firmware_host/base/time.h"

#include <optional>

namespace frustumscreen::service {

class ServiceManager {
public:
    /// Reads NOTIFY_SOCKET, WATCHDOG_USEC and WATCHDOG_PID once.
    ServiceManager();

    /// Longest interval between two feedings of the watchdog; nullopt = no watchdog for this process.
    [[nodiscard]] std::optional<Nanoseconds> watchdog_interval() const { return watchdog_interval_; }

    /// Whether there is a service manager.
    [[nodiscard]] bool listens() const { return listens_; }
    /// The exhibit is not ready yet; extends the start timeout by `at_most`.
    void still_starting(Nanoseconds at_most) const;
    void ready() const;
    void feed_watchdog() const;
    void stopping() const;
    /// One line for `systemctl status`; sent only when it changes.
    void status(const Sentence& sentence);

private:
    bool listens_;
    std::optional<Nanoseconds> watchdog_interval_;
    Sentence status_;
};

} // namespace frustumscreen::service
