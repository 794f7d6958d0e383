/// SIGTERM and SIGINT: they stay pending for the loop that looks for them, or end the process at once while
/// there is nothing to close yet.
///
/// Threads  constructed before any other thread is started, so that the signals stay pending in all of them.
/// Errors   none.
#pragma once

#include "firmware_host/base/time.h"

#include <csignal>

namespace frustumscreen {

class StopSignals {
public:
    StopSignals();
    StopSignals(const StopSignals&) = delete;
    StopSignals& operator=(const StopSignals&) = delete;

    /// A signal has come since the last call.
    [[nodiscard]] bool received() const;

    /// While it lives, a stop signal ends the process at once.
    class AtOnce {
    public:
        explicit AtOnce(const StopSignals& signals);
        ~AtOnce();
        AtOnce(const AtOnce&) = delete;
        AtOnce& operator=(const AtOnce&) = delete;

    private:
        const StopSignals& signals_;
    };

private:
    sigset_t set_{};
};

/// Ends the process after `time` with this status, even if a thread does not come back from its device.
void end_within(Nanoseconds time, int status = 0);

} // namespace frustumscreen
