/// Checksums of the trackers' wire formats and of packet recordings.
///
/// Threads  pure functions; they allocate nothing.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace frustumscreen::tracker {

/// CRC-16/ARC: reflected polynomial 0xA001, initial value 0. "123456789" gives 0xBB3D.
[[nodiscard]] std::uint16_t crc16_arc(std::span<const std::byte> bytes);

/// CRC-32 of IEEE 802.3: reflected polynomial 0xEDB88320, initial value and final XOR all ones. "123456789"
/// gives 0xCBF43926.
[[nodiscard]] std::uint32_t crc32_ieee(std::span<const std::byte> bytes);

} // namespace frustumscreen::tracker
