/// The bytes of a Polhemus PATRIOT or LIBERTY: binary frames of one sensor each, and lines of text in set-up.
///
/// Layout   little-endian: 'PA' | 'LY' | 'LU', u8 sensor from 1, u8 command ('C' or 'P'), u8 error (space =
///          good), u8 reserved, u16 size of the payload = 40: u32 milliseconds, u32 frame counter, i32
///          distortion, f32[3] position in centimetres, f32[4] quaternion w first. `O*,8,9,11,3,7` chooses
///          this payload.
/// Errors   values; any bytes are safe. The family has no checksum: headers, size and the quaternion's length
///          are checked here, the counter by the policy; a changed low digit of a position cannot be noticed
///          beyond what USB's own CRC does.
/// Threads  pure functions; they allocate nothing.
/// Source   public drivers. Not yet compared with a device: the text that answers `U` and `H`.
#pragma once

#include "firmware_host/tracker/viper_codec.h"

#include <optional>
#include <string_view>

namespace frustumscreen {

using PatriotMessage = std::variant<NeedMore, DiscardReason, DeviceFrame>;
struct PatriotStep {
    std::size_t consumed = 0; ///< 0 only with NeedMore
    PatriotMessage message;
};
[[nodiscard]] PatriotStep parse_patriot(std::span<const std::byte> stream);

/// The number that answers the question about units, '<station>U<error><digit>': 0 inches, 1 centimetres.
/// None: no whole line in `text` is such an answer.
[[nodiscard]] std::optional<int> patriot_units_answer(std::string_view text);

} // namespace frustumscreen
