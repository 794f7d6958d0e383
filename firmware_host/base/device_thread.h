/// What every thread but the exhibit's own begins with and sleeps by.
#pragma once

#include "firmware_host/base/time.h"

#include <cstdint>
#include <stop_token>

namespace frustumscreen {

/// Low: nice 5, where the kernel allows that. The thread gives way to the picture, and still runs on a busy machine.
enum class ThreadPriority : std::uint8_t { Usual, Low };

/// `name` has at most 15 bytes; `top -H` and debuggers show it. SIGTERM and SIGINT are left to the exhibit's thread, which closes
/// what is open before it ends (firmware_host/service/stop_signals.h).
void begin_device_thread(const char* name, ThreadPriority priority = ThreadPriority::Usual);

/// Returns after `length`, or as soon as a stop is requested. Allocates nothing.
void sleep_until_stop(const std::stop_token& stop, Nanoseconds length);

} // namespace frustumscreen
