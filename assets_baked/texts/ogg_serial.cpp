#include "assets_baked/texts/ogg_serial.h"

#include <cstring>
#include <span>
#include <string_view>

namespace frustumscreen::texts {

namespace {

constexpr std::size_t header_bytes = 27;
constexpr std::size_t serial_at = 14;
constexpr std::size_t checksum_at = 22;
constexpr std::size_t segments_at = 26;

/// Polynomial 0x04c11db7, neither inverted nor mirrored.
std::uint32_t checksum(std::span<const std::byte> page) {
    std::uint32_t sum = 0;
    for (const std::byte byte : page) {
        sum ^= std::to_integer<std::uint32_t>(byte) << 24U;
        for (int bit = 0; bit < 8; ++bit) {
            sum = (sum << 1U) ^ ((sum >> 31U) != 0 ? 0x04c11db7U : 0U);
        }
    }
    return sum;
}

/// Size of the page; 0 if `bytes` do not begin with a whole page.
std::size_t page_bytes(std::span<const std::byte> bytes) {
    if (bytes.size() < header_bytes || as_text(bytes.first(4)) != std::string_view("OggS")) {
        return 0;
    }
    const auto segments = std::to_integer<std::size_t>(bytes[segments_at]);
    std::size_t size = header_bytes + segments;
    for (std::size_t k = 0; k < segments && header_bytes + k < bytes.size(); ++k) {
        size += std::to_integer<std::size_t>(bytes[header_bytes + k]);
    }
    return size <= bytes.size() ? size : 0;
}

} // namespace

void set_ogg_serial(Bytes& ogg, std::uint32_t serial) {
    std::span<std::byte> rest(ogg);
    while (const std::size_t size = page_bytes(rest)) {
        const std::span<std::byte> page = rest.first(size);
        std::memcpy(page.data() + serial_at, &serial, sizeof(serial));
        std::memset(page.data() + checksum_at, 0, sizeof(std::uint32_t));
        const std::uint32_t sum = checksum(page);
        std::memcpy(page.data() + checksum_at, &sum, sizeof(sum));
        rest = rest.subspan(size);
    }
}

} // namespace frustumscreen::texts
