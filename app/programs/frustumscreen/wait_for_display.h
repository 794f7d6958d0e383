/// The display of a run: a service waits for a graphics card whose driver comes late, and for a while for a card that cannot be
/// used yet; a person is told at once.
///
/// Threads  the main one.
/// Errors   as make_display; for a service only after `longest_boot`, and never that there is no card.
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

namespace frustumscreen {

/// While the machine boots, udev may not have given the card to the exhibit's user yet.
inline constexpr Nanoseconds longest_boot = std::chrono::seconds(30);

/// How a display is looked for.
struct DisplaySearch {
    std::function<Result<std::unique_ptr<Display>>()> make;
    std::function<std::unique_ptr<Hotplug>()> make_hotplug =
        make_udev_hotplug; ///< called when it has to wait
    std::function<MonotonicTime()> now = monotonic_now;
};

/// While it waits, a stop signal ends the process at once: nothing is open yet.
[[nodiscard]] Result<std::unique_ptr<Display>> wait_for_display(const DisplaySearch& search,
                                                                const StopSignals& stop_signals,
                                                                ServiceManager& manager,
                                                                const Journal& journal);

} // namespace frustumscreen
