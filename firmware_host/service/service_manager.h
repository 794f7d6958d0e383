/// Tells the service manager the exhibit's state: sd_notify(3). Without a service manager it does nothing.
///
/// Threads  one caller; a call sends one datagram.
/// Errors   none: where nobody listens, a message is lost.
#pragma once

#include "firmware_host/base/sentence.h"
#include "firmware_host/base/time.h"

#include <optional>

namespace frustumscreen {

class ServiceManager {
public:
    /// Reads NOTIFY_SOCKET, WATCHDOG_USEC and WATCHDOG_PID as they are now.
    ServiceManager();

    /// How often its watchdog wants to be fed at least; nothing = it has none for this process.
    [[nodiscard]] std::optional<Nanoseconds> watchdog_interval() const { return watchdog_interval_; }

    /// There is a service manager.
    [[nodiscard]] bool listens() const { return listens_; }
    /// The exhibit is not ready yet; it must not be given up for another `at_most`.
    void still_starting(Nanoseconds at_most) const;
    void ready() const;
    void feed_watchdog() const;
    void stopping() const;
    /// One line for `systemctl status`; sent when it differs from the one before.
    void status(const Sentence& sentence);

private:
    bool listens_;
    std::optional<Nanoseconds> watchdog_interval_;
    Sentence status_;
};

} // namespace frustumscreen
