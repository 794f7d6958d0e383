#include "firmware_host/tracker/crc.h"

#include <array>

namespace frustumscreen::tracker {

namespace {

template <typename Word> constexpr std::array<Word, 256> reflected_table(Word polynomial) {
    std::array<Word, 256> table{};
    for (unsigned byte = 0; byte < table.size(); ++byte) {
        auto crc = static_cast<Word>(byte);
        for (int bit = 0; bit < 8; ++bit) {
            const bool one = (crc & 1U) != 0;
            crc = static_cast<Word>(crc >> 1U);
            crc = one ? static_cast<Word>(crc ^ polynomial) : crc;
        }
        table[byte] = crc;
    }
    return table;
}

template <typename Word>
Word divide(std::span<const std::byte> bytes, const std::array<Word, 256>& table, Word crc) {
    for (const std::byte byte : bytes) {
        crc = static_cast<Word>(crc >> 8U ^ table[(crc ^ static_cast<unsigned>(byte)) & 0xFFU]);
    }
    return crc;
}

constexpr auto arc = reflected_table<std::uint16_t>(0xA001U);
constexpr auto ieee = reflected_table<std::uint32_t>(0xEDB88320U);

} // namespace

std::uint16_t crc16_arc(std::span<const std::byte> bytes) {
    return divide<std::uint16_t>(bytes, arc, 0);
}

std::uint32_t crc32_ieee(std::span<const std::byte> bytes) {
    return ~divide<std::uint32_t>(bytes, ieee, 0xFFFFFFFFU);
}

} // namespace frustumscreen::tracker
