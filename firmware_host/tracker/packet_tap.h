/// The packets between a tracker's transport and its session, for a recorder.
///
/// Calls    in the order of the session's calls, with their times; replayed into another session they give
///          the same samples.
/// Threads  the device's own; a tap returns at once.
#pragma once

#include "firmware_host/tracker/device_session.h"

#include <array>

namespace frustumscreen::tracker {

/// These numbers are stored in recordings.
enum class PacketKind : std::uint32_t {
    About = 1,    ///< text: recording program and time
    Opened = 2,   ///< OpenedDevice: a session begins
    Received = 3, ///< bytes from the device; empty: none came in time
    Sent = 4,     ///< bytes from the session to the device
    Closed = 5,   ///< empty; the session is over
    State = 6,    ///< text: sentence of the new state
    Dropped = 7,  ///< u64: number of packets missing here
};

class PacketTap {
public:
    virtual ~PacketTap() = default;
    virtual void packet(PacketKind kind, MonotonicTime time, std::span<const std::byte> payload) = 0;
};

/// Parameters of a session: u32 model, u32 0, f64[3] hemisphere, f64[2] half the table.
struct OpenedDevice {
    static constexpr std::size_t size = 48;

    UsbTrackerModel model = UsbTrackerModel::Viper;
    UsbTrackerSetUp set_up;

    [[nodiscard]] std::array<std::byte, size> bytes() const;
    /// nullopt: wrong size, unknown model, or numbers that are not finite.
    [[nodiscard]] static std::optional<OpenedDevice> from(std::span<const std::byte> bytes);
};

} // namespace frustumscreen::tracker
