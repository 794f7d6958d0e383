/// Set-up and sleep of every thread except the exhibit's main thread.
#pragma once

#include "firmware_host/base/time.h"

#include <cstdint>
#include <stop_token>

namespace frustumscreen {

/// Low: nice 5, if the kernel allows it. The thread yields to the picture, but still runs on a busy machine.
enum class ThreadPriority : std::uint8_t { Usual, Low };

/// `name` has at most 15 bytes; `top -H` and debuggers show it. Blocks SIGTERM and SIGINT: the exhibit's main
/// thread handles them and closes everything before the process ends (firmware_host/service/stop_signals.h).
void begin_device_thread(const char* name, ThreadPriority priority = ThreadPriority::Usual);

/// Returns after `length`, or as soon as a stop is requested. Does not allocate.
void sleep_until_stop(const std::stop_token& stop, Nanoseconds length);

} // namespace frustumscreen
