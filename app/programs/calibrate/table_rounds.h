/// The rounds of a procedure on the table: what is shown, what is heard, one after the other until it has ended.
///
/// Time     the devices'. Between two rounds it is waited; without a screen nobody looks on, and that time is passed over.
/// Errors   the display stops.
/// Threads  the main one, with the display's context current.
#pragma once

#include "app/programs/calibrate/table_devices.h"

#include <functional>

namespace frustumscreen {

/// What a round consists of.
struct TableRounds {
    std::function<Result<void>(MonotonicTime)> show; ///< what the procedure asks for
    std::function<bool()> has_ended;                 ///< whichever way
    std::function<void(MonotonicTime)> step; ///< what is heard goes to it; what it waits for is computed
    Nanoseconds between = std::chrono::milliseconds(20);
    bool with_camera = false; ///< its frames come in the system's time, of which nothing is passed over
};

/// False: it was told to stop.
[[nodiscard]] Result<bool> run_rounds(TableDevices& devices, const TableRounds& rounds);
/// Leaves the last words to be read.
void stay(TableDevices& devices, const TableRounds& rounds);

} // namespace frustumscreen
