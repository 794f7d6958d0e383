/// USB trackers through libusb 1.0: found by vendor and product id, read and written by bulk transfers.
///
/// Threads  one; libusb is initialised by the first search.
#pragma once

#include "firmware_host/tracker/usb_transport.h"

namespace frustumscreen::tracker {

[[nodiscard]] std::unique_ptr<UsbBus> make_libusb_bus();

} // namespace frustumscreen::tracker
