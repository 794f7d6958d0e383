/// The bytes of a Polhemus PATRIOT or LIBERTY: binary frames of one sensor each, and lines of text during
/// set-up.
///
/// Layout   little-endian: 'PA' | 'LY' | 'LU', u8 sensor from 1, u8 command ('C' or 'P'), u8 error (space =
///          good), u8 reserved, u16 size of the payload = 40: u32 milliseconds, u32 frame counter, i32
///          distortion, f32[3] position in centimetres, f32[4] quaternion w first. `O*,8,9,11,3,7` chooses
///          this payload.
/// Errors   values; any bytes are safe. The family has no checksum. This codec checks headers, size and the
///          quaternion's length; the sequence checker checks the counter. Only USB's own CRC protects the low
///          digits of a position.
/// Threads  pure functions; they allocate nothing.
/// Source   public drivers. Not yet compared with a device: the texts that answer `U` and `H`.
#pragma once

#include "firmware_host/tracker/viper_codec.h"

#include <optional>
#include <string_view>

namespace frustumscreen::tracker {

using PatriotMessage = std::variant<NeedMore, DiscardReason, DeviceFrame>;
struct PatriotStep {
    std::size_t consumed = 0; ///< 0 only with NeedMore
    PatriotMessage message;
};
[[nodiscard]] PatriotStep parse_patriot(std::span<const std::byte> stream);

/// The number in the answer to the question about units, '<station>U<error><digit>': 0 inches, 1 centimetres.
/// nullopt: no complete line of `text` is such an answer.
[[nodiscard]] std::optional<int> patriot_units_answer(std::string_view text);

} // namespace frustumscreen::tracker
