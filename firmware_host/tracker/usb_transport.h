/// The way to a USB tracker: bytes in, bytes out, and how one is found.
///
/// Threads  the device's own thread; every call may block for as long as it is told, and no longer.
/// Errors   DeviceLost: unplugged or unusable; close it and look for one again.
#pragma once

#include "firmware_host/base/result.h"
#include "firmware_host/base/time.h"
#include "firmware_host/tracker/usb_tracker_state.h"

#include <cstddef>
#include <memory>
#include <span>

namespace frustumscreen {

class UsbTransport {
public:
    virtual ~UsbTransport() = default;
    /// Some bytes, at most buffer.size(); 0: none came in time.
    [[nodiscard]] virtual Result<std::size_t> read(std::span<std::byte> buffer, Nanoseconds timeout) = 0;
    [[nodiscard]] virtual Result<void> write(std::span<const std::byte> bytes, Nanoseconds timeout) = 0;
    /// Gives the device back; nothing is read or written after.
    virtual void close() = 0;
};

enum class UsbTrackerModel { Viper, Patriot, Liberty };

struct FoundTracker {
    std::unique_ptr<UsbTransport> transport; ///< open
    UsbTrackerModel model = UsbTrackerModel::Viper;
};

class UsbBus {
public:
    virtual ~UsbBus() = default;
    /// Opens the first tracker that can be opened; else says what is in the way.
    [[nodiscard]] virtual tl::expected<FoundTracker, UsbTrackerState> find() = 0;
};

} // namespace frustumscreen
