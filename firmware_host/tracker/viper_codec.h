/// The bytes of a Polhemus VIPER: frames of poses, commands and their replies.
///
/// Layout   little-endian: u32 preamble, u32 size of all that follows, body, u32 CRC over everything before.
///          Preamble 'VPRP' for poses: u32 serial, u32 frame counter, u32 info, u32 sensor count, then 32
///          bytes each sensor. Preamble 'VPRC' for commands and replies: u32 serial, u32 command, u32 action,
///          u32 arg1, u32 arg2, payload. CRC-16/ARC in a u32.
/// Errors   values; any bytes are safe, nothing is read past the span.
/// Threads  pure functions; they allocate nothing.
/// Source   Polhemus' documentation of the VIPER's USB protocol as public drivers use it. Not held against a
///          device yet: the payload of `Filter`, and that sensor 0 on the wire is connector 1.
#pragma once

#include "firmware_host/tracker/crc.h"
#include "firmware_host/tracker/device_frame.h"

#include <span>
#include <variant>

namespace frustumscreen {

enum class ViperCommand : std::uint32_t {
    Hemisphere = 0, ///< u32 track, f32[3] towards the half space in which the sensors are
    Filter = 1,     ///< f32[4] F, FLow, FHigh, factor; arg2 0 position, 1 orientation
    FrameRate = 6,  ///< u32: 30 Hz << value, 0 to 5
    Units = 7,      ///< u32 position (3 = metres), u32 orientation (2 = quaternion)
    Continuous = 19,
    WhoAmI = 20,
};
enum class ViperAction : std::uint32_t { Set = 0, Get = 1, Reset = 2, Ack = 3, Nak = 4, NakWarning = 5 };
/// The first number in a Nak's payload.
enum class ViperNak : std::uint32_t { General = 0, Booting = 1, Command = 2, BuiltInTest = 3 };

inline constexpr std::uint32_t viper_all_sensors = 0xFFFFFFFFU;
inline constexpr std::uint32_t viper_metres = 3;
inline constexpr std::uint32_t viper_quaternion = 2;

/// What the stream begins with, and how many bytes of it are then done with.
struct ViperReply {
    std::uint32_t command = 0;
    std::uint32_t action = 0;
    std::span<const std::byte> payload; ///< into the stream that was parsed
};
struct NeedMore {};
using ViperMessage = std::variant<NeedMore, Refusal, DeviceFrame, ViperReply>;
struct ViperStep {
    std::size_t consumed = 0; ///< 0 only with NeedMore
    ViperMessage message;
};
/// A broken frame costs no more than the bytes up to the next preamble, so a good one inside it is found.
[[nodiscard]] ViperStep parse_viper(std::span<const std::byte> stream);

/// A command ready to be sent.
class ViperCommandBytes {
public:
    ViperCommandBytes(ViperCommand command, ViperAction action, std::span<const std::byte> payload = {},
                      std::uint32_t arg1 = viper_all_sensors, std::uint32_t arg2 = 0);
    [[nodiscard]] std::span<const std::byte> bytes() const { return {bytes_.data(), size_}; }

private:
    static constexpr std::size_t most_payload = 32;
    std::array<std::byte, 32 + most_payload> bytes_{};
    std::size_t size_ = 0;
};

} // namespace frustumscreen
