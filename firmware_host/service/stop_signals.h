/// SIGTERM and SIGINT: waiting in line for the loop that looks for them, or ending the process at once while
/// there is nothing to put away yet.
///
/// Threads  constructed before any other thread is started, so that they wait in line in all of them.
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

    /// One has come since it was last asked.
    [[nodiscard]] bool received() const;

    /// While it lives, a stop ends the process there and then, as if nobody had held it.
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

/// The process ends that much later, with status 0, even if a thread does not come back from its device.
void end_within(Nanoseconds time);

} // namespace frustumscreen
