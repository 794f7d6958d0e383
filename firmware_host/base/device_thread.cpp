#include "firmware_host/base/device_thread.h"

#include <pthread.h>
#include <sys/resource.h>

#include <condition_variable>
#include <csignal>
#include <mutex>

namespace frustumscreen {

void begin_device_thread(const char* name, ThreadPriority priority) {
    ::pthread_setname_np(::pthread_self(), name);
    sigset_t stops;
    sigemptyset(&stops);
    sigaddset(&stops, SIGTERM);
    sigaddset(&stops, SIGINT);
    ::pthread_sigmask(SIG_BLOCK, &stops, nullptr);
    if (priority == ThreadPriority::Low) {
        constexpr int niceness = 5;
        // On Linux, affects only the calling thread.
        static_cast<void>(::setpriority(PRIO_PROCESS, 0, niceness));
    }
}

void sleep_until_stop(const std::stop_token& stop, Nanoseconds length) {
    std::mutex mutex;
    std::condition_variable changed;
    bool is_stopped = false;
    const std::stop_callback wake(stop, [&] {
        const std::lock_guard lock(mutex);
        is_stopped = true;
        changed.notify_one();
    });
    std::unique_lock lock(mutex); // after `wake`, whose destructor waits for a callback that needs the mutex
    changed.wait_for(lock, length, [&] { return is_stopped; });
}

} // namespace frustumscreen
