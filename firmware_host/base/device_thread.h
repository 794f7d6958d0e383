/// Every thread except the exhibit's own begins with this.
///
/// `name` has at most 15 bytes; `top -H` and debuggers show it. SIGTERM and SIGINT are left to the exhibit's
/// thread, which closes what is open before it ends (firmware_host/service/stop_signals.h).
#pragma once

#include <pthread.h>

#include <csignal>

namespace frustumscreen {

inline void begin_device_thread(const char* name) {
    ::pthread_setname_np(::pthread_self(), name);
    sigset_t stops;
    sigemptyset(&stops);
    sigaddset(&stops, SIGTERM);
    sigaddset(&stops, SIGINT);
    ::pthread_sigmask(SIG_BLOCK, &stops, nullptr);
}

} // namespace frustumscreen
