#include "firmware_host/service/stop_signals.h"

#include "firmware_host/base/device_thread.h"

#include <sys/time.h>
#include <unistd.h>

#include <csignal>
#include <string_view>

namespace frustumscreen::service {

namespace {

volatile std::sig_atomic_t status_of_end = 0;

extern "C" void end_now(int) {
    constexpr std::string_view line = "frustumscreen: did not stop in time; ended at once\n";
    [[maybe_unused]] const ssize_t written = ::write(STDERR_FILENO, line.data(), line.size());
    ::_exit(status_of_end);
}

} // namespace

StopSignals::StopSignals() {
    sigemptyset(&set_);
    sigaddset(&set_, SIGTERM);
    sigaddset(&set_, SIGINT);
    ::pthread_sigmask(SIG_BLOCK, &set_, nullptr);
}

bool StopSignals::received() const {
    const timespec at_once{};
    return ::sigtimedwait(&set_, nullptr, &at_once) > 0;
}

StopSignals::AtOnce::AtOnce(const StopSignals& signals)
    : thread_([set = signals.set_](const std::stop_token& stop) {
          begin_device_thread("stop at once");
          ::pthread_sigmask(SIG_UNBLOCK, &set, nullptr);
          while (!stop.stop_requested()) {
              sleep_until_stop(stop, std::chrono::hours(1));
          }
      }) {}

void end_within(Nanoseconds time, int status) {
    status_of_end = status;
    struct sigaction action {};
    action.sa_handler = end_now;
    ::sigaction(SIGALRM, &action, nullptr);
    const auto us = std::chrono::duration_cast<std::chrono::microseconds>(time).count();
    const itimerval once{{}, {us / 1'000'000, us % 1'000'000}};
    ::setitimer(ITIMER_REAL, &once, nullptr);
}

} // namespace frustumscreen::service
