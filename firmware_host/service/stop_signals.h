/// SIGTERM and SIGINT: they stay pending until the main loop looks for them. Before there is anything to
/// close, they end the process at once.
///
/// Threads  construct it before any other thread starts, so the signals stay pending in all threads.
/// Errors   none.
#pragma once

#include "firmware_host/base/time.h"

#include <csignal>
#include <thread>

namespace frustumscreen::service {

class StopSignals {
public:
    StopSignals();
    StopSignals(const StopSignals&) = delete;
    StopSignals& operator=(const StopSignals&) = delete;

    /// Whether a signal has come since the last call.
    [[nodiscard]] bool received() const;

    /// During its lifetime a stop signal ends the process at once. A thread of its own takes the signal: if the caller
    /// took it, each thread started meanwhile would inherit that, and a later signal could end the process there.
    class AtOnce {
    public:
        explicit AtOnce(const StopSignals& signals);
        AtOnce(const AtOnce&) = delete;
        AtOnce& operator=(const AtOnce&) = delete;

    private:
        std::jthread thread_;
    };

private:
    sigset_t set_{};
};

/// Ends the process after `time` with this status, even if a thread is stuck in a device.
void end_within(Nanoseconds time, int status = 0);

} // namespace frustumscreen::service
