/// The way to a USB tracker: bytes in, bytes out, and how one is found.
///
/// Bytes    of a bulk endpoint: a stream. Of a HID device: one whole report a read, its id in front; the
///          feature report that the transport asks for when it opens a HID tracker comes first.
/// Threads  the device's own thread; every call may block for as long as it is told, and no longer.
/// Errors   DeviceLost: unplugged or unusable; close it and look for one again.
#pragma once

#include "firmware_host/base/result.h"
#include "firmware_host/base/time.h"
#include "firmware_host/tracker/usb_tracker_state.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>

namespace frustumscreen {

class UsbTransport {
public:
    virtual ~UsbTransport() = default;
    /// Some bytes, at most buffer.size(); 0: none came in time.
    [[nodiscard]] virtual Result<std::size_t> read(std::span<std::byte> buffer, Nanoseconds timeout) = 0;
    /// A device that does not take them in time is no error here: it will not answer either.
    [[nodiscard]] virtual Result<void> write(std::span<const std::byte> bytes, Nanoseconds timeout) = 0;
    /// Gives the device back; nothing is read or written after.
    virtual void close() = 0;
};

/// The numbers are written into recordings.
enum class UsbTrackerModel : std::uint32_t { Viper = 1, Patriot = 2, Liberty = 3, Hid = 4, SpaceMouse = 5 };

struct FoundTracker {
    std::unique_ptr<UsbTransport> transport; ///< open; must be destroyed before its bus
    UsbTrackerModel model = UsbTrackerModel::Viper;
    std::string place; ///< where it is plugged in; differs between devices
};

class UsbBus {
public:
    virtual ~UsbBus() = default;
    /// Opens the first tracker that can be opened; else says what prevents it. Devices at the places
    /// `but_not` are skipped.
    [[nodiscard]] virtual tl::expected<FoundTracker, UsbTrackerState>
    find(std::span<const std::string> but_not) = 0;
    /// Whether its devices' poses are in the table's frame, not in the device's own.
    [[nodiscard]] virtual bool reports_table_frame() const { return false; }
};

} // namespace frustumscreen
