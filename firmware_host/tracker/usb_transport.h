/// The transport to a USB tracker, and the search for one.
///
/// Bytes    from a bulk endpoint: a stream; from a HID device: one whole report per read, its id first. The
///          feature report, which the transport requests when it opens a HID tracker, comes first.
/// Threads  the device's own thread; a call blocks no longer than its timeout.
/// Errors   DeviceLost: unplugged or unusable; close it and search again.
#pragma once

#include "firmware_host/base/result.h"
#include "firmware_host/base/time.h"
#include "firmware_host/tracker/usb_tracker_state.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>

namespace frustumscreen::tracker {

class UsbTransport {
public:
    virtual ~UsbTransport() = default;
    /// Up to buffer.size() bytes; 0 if none came in time.
    [[nodiscard]] virtual Result<std::size_t> read(std::span<std::byte> buffer, Nanoseconds timeout) = 0;
    /// A timeout is no error: a device that takes no bytes does not answer either, and the session notices
    /// that.
    [[nodiscard]] virtual Result<void> write(std::span<const std::byte> bytes, Nanoseconds timeout) = 0;
    /// Releases the device; no reads or writes may follow.
    virtual void close() = 0;
};

/// These numbers are stored in recordings.
enum class UsbTrackerModel : std::uint32_t { Viper = 1, Patriot = 2, Liberty = 3, Hid = 4, SpaceMouse = 5 };

struct FoundTracker {
    std::unique_ptr<UsbTransport> transport; ///< open; must be destroyed before its bus
    UsbTrackerModel model = UsbTrackerModel::Viper;
    std::string place; ///< port that it is plugged into; unique to a device
};

class UsbBus {
public:
    virtual ~UsbBus() = default;
    /// Opens the first tracker that can be opened, except at the places `but_not`; otherwise returns the
    /// obstacle.
    [[nodiscard]] virtual tl::expected<FoundTracker, UsbTrackerState>
    find(std::span<const std::string> but_not) = 0;
    /// Whether the poses are in the table's frame, not the device's own.
    [[nodiscard]] virtual bool reports_table_frame() const { return false; }
};

} // namespace frustumscreen::tracker
