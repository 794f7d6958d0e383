/// The dates in a ZIP archive, read by its specification alone.
///
/// Source  PKWARE, APPNOTE.TXT 6.3.3: 4.3.7 local file header, 4.3.12 central directory header
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace frustumscreen::samples {

/// Time and date, as MS-DOS packs them, of every header, in both places of each entry.
inline std::vector<std::uint32_t> zip_dates(std::span<const std::byte> archive) {
    const auto number = [&](std::size_t at, std::size_t bytes) {
        std::uint32_t value = 0;
        for (std::size_t k = 0; k < bytes; ++k) {
            value |= std::to_integer<std::uint32_t>(archive[at + k]) << (8 * k);
        }
        return value;
    };
    constexpr std::size_t end_bytes = 22; // of an archive without a comment
    std::vector<std::uint32_t> dates;
    std::size_t at = number(archive.size() - end_bytes + 16, 4);
    while (number(at, 4) == 0x02014b50) {
        dates.push_back(number(at + 12, 4));
        dates.push_back(number(number(at + 42, 4) + 10, 4));
        at += 46 + number(at + 28, 2) + number(at + 30, 2) + number(at + 32, 2);
    }
    return dates;
}

/// 1 January 1980, midnight: the earliest possible date.
inline constexpr std::uint32_t earliest_zip_date = 0x00210000;

} // namespace frustumscreen::samples
