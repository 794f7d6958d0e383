/// Reports when something is plugged into a graphics card or pulled out.
#pragma once

#include "firmware_host/base/time.h"

#include <memory>

namespace frustumscreen {

class Hotplug {
public:
    virtual ~Hotplug() = default;
    /// Waits for an event, at most `at_most` or until `wake`; true if there was one.
    [[nodiscard]] virtual bool wait(Nanoseconds at_most) = 0;
    /// Ends the current wait, or the next one; any thread may call it.
    virtual void wake() = 0;
};

/// Events of udev. Where there is no udev, none ever comes and every wait takes its full time.
[[nodiscard]] std::unique_ptr<Hotplug> make_udev_hotplug();

} // namespace frustumscreen
