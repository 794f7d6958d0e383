/// Told when something is plugged into a graphics card, or pulled out.
#pragma once

#include "firmware_host/base/time.h"

#include <memory>

namespace frustumscreen {

class Hotplug {
public:
    virtual ~Hotplug() = default;
    /// Waits for it, at most so long, or until `wake`: was there any?
    [[nodiscard]] virtual bool wait(Nanoseconds at_most) = 0;
    /// Ends the wait that is under way, or the next one. Any thread.
    virtual void wake() = 0;
};

/// From udev. Where there is no udev, nothing is ever heard and every wait takes its time.
[[nodiscard]] std::unique_ptr<Hotplug> make_udev_hotplug();

} // namespace frustumscreen
