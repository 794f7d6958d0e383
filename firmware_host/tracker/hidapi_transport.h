/// HID trackers through hidapi on the kernel's hidraw devices.
///
/// Threads  one; hidapi is initialised by the first search. A read waits no longer than its timeout. If the
///          device hangs while it is opened, the request for its feature report may take the kernel's own 5
///          s.
#pragma once

#include "firmware_host/tracker/usb_transport.h"

namespace frustumscreen::tracker {

/// Finds devices of `model` only: Hid or SpaceMouse.
[[nodiscard]] std::unique_ptr<UsbBus> make_hid_bus(UsbTrackerModel model);

} // namespace frustumscreen::tracker
