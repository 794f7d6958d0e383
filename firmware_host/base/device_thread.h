/// What every thread but the exhibit's own begins with.
///
/// Its name, of at most 15 bytes, is for whoever looks at the process from outside (`top -H`, a debugger).
/// SIGTERM and SIGINT are left to the exhibit's thread, which puts away what is open before it ends
/// (firmware_host/service/stop_signals.h).
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
