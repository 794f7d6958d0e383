/// The watchdog's report of itself and of the kiosk, as JSON; docs/status.md describes the fields.
///
/// Threads  pure; any.
#pragma once

#include "app/programs/watchdog/fault_book.h"
#include "app/watch/ladder.h"

#include <deque>
#include <string>
#include <vector>

namespace frustumscreen::programs {

struct WatchdogReport {
    MonotonicTime now;
    std::string at; ///< by the wall clock, UTC
    std::string boot_id;
    watch::LadderMemory memory;
    watch::Observation seen;
    Nanoseconds trouble_for{0}; ///< duration of the current fault, if any
    std::size_t reboots_within_day = 0;
    std::uint32_t failures = 0; ///< failures of the exhibit's process since the boot
    std::string last_end;       ///< latest end of the process; empty: there was none
    std::vector<std::string> notes;
};

[[nodiscard]] std::string watchdog_json(const WatchdogReport& report, const std::deque<Fault>& faults);

} // namespace frustumscreen::programs
