/// Opens the display of a run. A service waits for a graphics card whose driver loads late, and for a limited time for
/// a card that cannot be used yet; a run by a person fails at once.
///
/// Threads  the main one.
/// Errors   as make_display. A service fails only after `longest_boot`, and never because there is no card.
#pragma once

#include "firmware_host/base/result.h"
#include "firmware_host/base/time.h"
#include "firmware_host/display/display.h"
#include "firmware_host/display/hotplug.h"
#include "firmware_host/service/journal.h"
#include "firmware_host/service/service_manager.h"
#include "firmware_host/service/stop_signals.h"

#include <functional>
#include <memory>

namespace frustumscreen::programs {

/// While the machine boots, udev may not have given the card to the exhibit's user yet.
inline constexpr Nanoseconds longest_boot = std::chrono::seconds(30);

/// The ways to look for a display.
struct DisplaySearch {
    std::function<Result<std::unique_ptr<display::Display>>()> make;
    std::function<std::unique_ptr<display::Hotplug>()> make_hotplug =
        display::make_udev_hotplug; ///< called when it has to wait
    std::function<MonotonicTime()> now = monotonic_now;
};

/// During the wait, a stop signal ends the process at once, because nothing is open yet.
[[nodiscard]] Result<std::unique_ptr<display::Display>>
wait_for_display(const DisplaySearch& search, const service::StopSignals& stop_signals,
                 service::ServiceManager& manager, const service::Journal& journal);

} // namespace frustumscreen::programs
