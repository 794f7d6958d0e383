/// The bytes of a Polhemus VIPER: frames of poses, commands and their replies.
///
/// Layout   little-endian: u32 preamble, u32 size of all that follows, body, u32 CRC over everything before.
///          Preamble 'VPRP' for poses: u32 serial, u32 frame counter, u32 info, u32 sensor count, then 32
///          bytes each sensor. Preamble 'VPRC' for commands and replies: u32 serial, u32 command, u32 action,
///          u32 arg1 (the sensor), u32 arg2, payload. CRC-16/ARC in a u32.
/// Errors   values; any bytes are safe, nothing is read past the span.
/// Threads  pure functions; they allocate nothing.
/// Source   ViperInterface.h, revision 200519a, of Polhemus, as published in sailboy1025/viper_linux, commit
///          db416f71; tests/tracker/fixtures/viper.txt has bytes made with it. Not yet compared with a
///          device.
#pragma once

#include "firmware_host/tracker/crc.h"
#include "firmware_host/tracker/device_frame.h"

#include <span>
#include <variant>

namespace frustumscreen::tracker {

enum class ViperCommand : std::uint32_t {
    Hemisphere = 0,  ///< of a sensor: u32 (bit 0 tracks, bit 1 automatic), f32[3] towards the half space of
                     ///< the sensors
    Filter = 1,      ///< of a sensor: u32 level (0 none), f32[4] used by level 4 only; arg2 is the target
    FrameRate = 6,   ///< u32: 30 Hz << value, 0 to 5
    Units = 7,       ///< u32 position (3 = metres), u32 orientation (2 = quaternion)
    Continuous = 19, ///< arg2 0: frames in the above layout
    WhoAmI = 20,
};
enum class ViperAction : std::uint32_t {
    Set = 0,
    Get = 1,
    Reset = 2,
    Ack = 3,
    Nak = 4,
    NakWarning = 5, ///< processed, with a warning; its payload is a Nak's
};
/// The command Get must name one of the two filters, not Both.
enum class ViperFilterTarget : std::uint32_t { Both = 0, Orientation = 1, Position = 2 };
/// The first number in a Nak's payload.
enum class ViperNak : std::uint32_t { General = 0, Booting = 1, Command = 2, BuiltInTest = 3 };

inline constexpr std::uint32_t viper_all_sensors = 0xFFFFFFFFU; ///< not for Get, which reads one sensor
inline constexpr std::uint32_t viper_metres = 3;
inline constexpr std::uint32_t viper_quaternion = 2;

struct ViperReply {
    std::uint32_t command = 0;
    std::uint32_t action = 0;
    std::span<const std::byte> payload; ///< into the stream that was parsed
};
struct NeedMore {};
using ViperMessage = std::variant<NeedMore, DiscardReason, DeviceFrame, ViperReply>;
/// The first message of the stream, and the number of bytes it used.
struct ViperStep {
    std::size_t consumed = 0; ///< 0 only with NeedMore
    ViperMessage message;
};
/// A broken frame discards only the bytes up to the next preamble, so a good frame inside it is found.
[[nodiscard]] ViperStep parse_viper(std::span<const std::byte> stream);

/// A command ready to be sent.
class ViperCommandBytes {
public:
    /// `sensor`: from 0; 0 also for commands to the whole device.
    ViperCommandBytes(ViperCommand command, ViperAction action, std::span<const std::byte> payload = {},
                      std::uint32_t sensor = 0, ViperFilterTarget target = ViperFilterTarget::Both);
    [[nodiscard]] std::span<const std::byte> bytes() const { return {bytes_.data(), size_}; }

private:
    static constexpr std::size_t max_payload = 32;
    std::array<std::byte, 32 + max_payload> bytes_{};
    std::size_t size_ = 0;
};

} // namespace frustumscreen::tracker
