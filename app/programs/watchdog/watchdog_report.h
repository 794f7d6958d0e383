/// What the watchdog says of itself and of the kiosk, as JSON: docs/status.md has the fields.
///
/// Threads  pure; any.
#pragma once

#include "app/programs/watchdog/fault_book.h"
#include "app/watch/ladder.h"

#include <deque>
#include <string>
#include <vector>

namespace frustumscreen {

struct WatchdogReport {
    MonotonicTime now;
    std::string at; ///< by the clock on the wall, UTC
    std::string boot_id;
    LadderMemory memory;
    Seen seen;
    Nanoseconds trouble_for{0}; ///< how long the trouble has been seen, if there is one
    std::size_t reboots_within_day = 0;
    std::uint32_t failures = 0; ///< of the exhibit's process since the boot
    std::string last_end;       ///< how it failed at last; empty: it did not
    std::vector<std::string> notes;
};

[[nodiscard]] std::string watchdog_json(const WatchdogReport& report, const std::deque<Fault>& faults);

} // namespace frustumscreen
