/// The service manager, told how the exhibit is: sd_notify(3). Without one, everything here does nothing.
///
/// Threads  one caller; a call sends one datagram.
/// Errors   none: who does not hear is not told.
#pragma once

#include "firmware_host/base/sentence.h"
#include "firmware_host/base/time.h"

#include <optional>

namespace frustumscreen {

class ServiceManager {
public:
    /// By NOTIFY_SOCKET, WATCHDOG_USEC and WATCHDOG_PID, as they are now.
    ServiceManager();

    /// How often its watchdog wants to be fed at least; nothing = it has none for this process.
    [[nodiscard]] std::optional<Nanoseconds> watchdog_interval() const { return watchdog_interval_; }

    /// There is one.
    [[nodiscard]] bool listens() const { return listens_; }
    /// Not ready yet, and not to be given up for so much longer.
    void still_starting(Nanoseconds at_most) const;
    void ready() const;
    void feed_watchdog() const;
    void stopping() const;
    /// For `systemctl status`: sent when it is another than before. One line.
    void status(const Sentence& sentence);

private:
    bool listens_;
    std::optional<Nanoseconds> watchdog_interval_;
    Sentence status_;
};

} // namespace frustumscreen
