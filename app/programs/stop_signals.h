/// SIGTERM and SIGINT, looked for where it suits the program.
///
/// Threads  `hold_stop_signals` before any other thread is started, which inherits it; the rest: the main
/// one.
#pragma once

#include <csignal>
#include <ctime>

namespace frustumscreen {

/// They wait in line from here on.
[[nodiscard]] inline sigset_t hold_stop_signals() {
    sigset_t signals{};
    sigemptyset(&signals);
    sigaddset(&signals, SIGTERM);
    sigaddset(&signals, SIGINT);
    pthread_sigmask(SIG_BLOCK, &signals, nullptr);
    return signals;
}

/// Whether one is in line; takes it out.
[[nodiscard]] inline bool told_to_stop(const sigset_t& signals) {
    const timespec at_once{};
    return ::sigtimedwait(&signals, nullptr, &at_once) > 0;
}

} // namespace frustumscreen
