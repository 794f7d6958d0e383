/// What passes between a tracker's transport and its session, for whoever records it.
///
/// Calls    in the order in which the session is called, with the same times: fed to another session in the
///          same way they give the same samples.
/// Threads  the device's own; a tap returns at once.
#pragma once

#include "firmware_host/tracker/device_session.h"

#include <array>

namespace frustumscreen {

/// The numbers are written into recordings.
enum class PacketKind : std::uint32_t {
    About = 1,    ///< text: which program recorded, and when
    Opened = 2,   ///< OpenedDevice: a session begins
    Received = 3, ///< bytes from the device; none: nothing came in time
    Sent = 4,     ///< bytes from the session to the device
    Closed = 5,   ///< nothing: the session is over
    State = 6,    ///< text: the sentence of the new state
    Dropped = 7,  ///< u64: so many packets are missing here
};

class PacketTap {
public:
    virtual ~PacketTap() = default;
    virtual void packet(PacketKind kind, MonotonicTime time, std::span<const std::byte> payload) = 0;
};

/// What a session is made of: u32 model, u32 0, f64[3] hemisphere, f64[2] half the table.
struct OpenedDevice {
    static constexpr std::size_t size = 48;

    UsbTrackerModel model = UsbTrackerModel::Viper;
    UsbTrackerSetUp set_up;

    [[nodiscard]] std::array<std::byte, size> bytes() const;
    /// Nothing: not of this size, a model that is not known, numbers that are none.
    [[nodiscard]] static std::optional<OpenedDevice> from(std::span<const std::byte> bytes);
};

} // namespace frustumscreen
