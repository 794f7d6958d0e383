/// HID trackers through hidapi on the kernel's hidraw devices.
///
/// Threads  one; hidapi is not even initialised before the first search. Reading waits no longer than told.
///          The one feature report, which is asked for when a HID tracker is opened, may take the kernel's
///          own 5 s if the device hangs just then.
#pragma once

#include "firmware_host/tracker/usb_transport.h"

namespace frustumscreen {

/// Finds devices of `model` alone: Hid or SpaceMouse.
[[nodiscard]] std::unique_ptr<UsbBus> make_hid_bus(UsbTrackerModel model);

} // namespace frustumscreen
