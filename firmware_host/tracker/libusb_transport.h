/// USB trackers through libusb 1.0: found by vendor and product id, read and written in bulk.
///
/// Threads  one; libusb is not even initialised before the first search.
#pragma once

#include "firmware_host/tracker/usb_transport.h"

namespace frustumscreen {

[[nodiscard]] std::unique_ptr<UsbBus> make_libusb_bus();

} // namespace frustumscreen
