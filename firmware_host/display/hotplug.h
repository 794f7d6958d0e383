/// Reports connections to and disconnections from a graphics card.
#pragma once

#include "firmware_host/base/time.h"

#include <memory>

namespace frustumscreen::display {

class Hotplug {
public:
    virtual ~Hotplug() = default;
    /// Waits for an event, at most `at_most` or until `wake`; returns true after an event.
    [[nodiscard]] virtual bool wait(Nanoseconds at_most) = 0;
    /// Ends the current wait, or the next one; any thread may call it.
    virtual void wake() = 0;
};

/// Events of udev. Without udev there are no events, and every wait takes its full time.
[[nodiscard]] std::unique_ptr<Hotplug> make_udev_hotplug();

} // namespace frustumscreen::display
