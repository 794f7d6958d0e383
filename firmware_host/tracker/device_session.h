/// The dialogue with one open device: set-up, verification, streaming. Bytes in, bytes out; no I/O.
///
/// Time     always a parameter, so a session runs under a simulated clock.
/// Threads  one caller; allocates nothing once `samples` has enough space.
#pragma once

#include "firmware_host/tracker/sequence_checker.h"
#include "firmware_host/tracker/usb_transport.h"

#include <memory>
#include <span>

namespace frustumscreen::tracker {

/// Settings of a tracker of any make.
struct UsbTrackerSetUp {
    /// In the tracker's frame: points from the source into the half space that holds the sensors, which the tracker
    /// cannot determine itself.
    glm::dvec3 hemisphere{1.0, 0.0, 0.0};
    /// Half the table along X and Y; the pose of a SpaceMouse stays within it.
    glm::dvec2 table_half_m{0.4, 0.25};
};

class DeviceSession {
public:
    virtual ~DeviceSession() = default;
    /// The command to send now; empty if none is due. Valid until the next call.
    [[nodiscard]] virtual std::span<const std::byte> due(MonotonicTime now) = 0;
    /// Decodes bytes that arrived at `arrival` and appends their samples to `samples`.
    virtual void receive(std::span<const std::byte> bytes, MonotonicTime arrival,
                         std::vector<PoseSample>& samples) = 0;
    [[nodiscard]] virtual UsbTrackerState state(MonotonicTime now) const = 0;
    /// This device will not stream: close it and search again.
    [[nodiscard]] virtual bool failed() const = 0;
    [[nodiscard]] virtual const SequenceChecker& intake() const = 0;
};

/// The session for a device of this model.
[[nodiscard]] std::unique_ptr<DeviceSession> make_session(UsbTrackerModel model,
                                                          const UsbTrackerSetUp& set_up);

/// Times that all makes share.
struct SessionTimes {
    static constexpr Nanoseconds reply = std::chrono::milliseconds(500); ///< then the command is sent again
    static constexpr Nanoseconds booting = std::chrono::milliseconds(300);
    static constexpr int tries = 3;
};

} // namespace frustumscreen::tracker
