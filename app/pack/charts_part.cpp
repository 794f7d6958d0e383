#include "app/pack/binary_parts.h"
#include "firmware_host/base/byte_reader.h"

#include <fmt/format.h>

#include <array>
#include <cstring>

namespace frustumscreen::pack {

namespace {

constexpr std::array<char, 4> charts_magic{'F', 'S', 'R', 'C'};
constexpr std::uint32_t charts_version = 1;
constexpr std::size_t header_bytes = 12;
constexpr std::size_t chart_bytes = 20;

} // namespace

Bytes encode_charts(const std::vector<ReliefChart>& charts) {
    Bytes bytes;
    bytes.reserve(header_bytes + charts.size() * chart_bytes);
    for (const char c : charts_magic) {
        append(bytes, c);
    }
    append(bytes, charts_version);
    append(bytes, static_cast<std::uint32_t>(charts.size()));
    for (const ReliefChart& chart : charts) {
        append(bytes, static_cast<std::uint16_t>(chart.direction));
        append(bytes, chart.x);
        append(bytes, chart.y);
        append(bytes, chart.width);
        append(bytes, chart.height);
        append(bytes, std::uint16_t{0});
        append(bytes, chart.u0_box);
        append(bytes, chart.v0_box);
    }
    return bytes;
}

Result<std::vector<ReliefChart>> decode_charts(std::span<const std::byte> bytes) {
    if (bytes.size() < header_bytes ||
        std::memcmp(bytes.data(), charts_magic.data(), charts_magic.size()) != 0) {
        return bad_input("charts.no_magic", "it does not begin as charts do (FSRC)");
    }
    ByteReader reader(bytes.subspan(charts_magic.size()));
    const auto version = reader.read<std::uint32_t>();
    const auto count = reader.read<std::uint32_t>();
    if (version != charts_version) {
        return bad_input("charts.version", "its charts have version {}, allowed is {}", version,
                         charts_version);
    }
    if (reader.left() != std::uint64_t{count} * chart_bytes) {
        return bad_input("charts.size", "{} charts need {} bytes, it has {}", count,
                         std::uint64_t{count} * chart_bytes, reader.left());
    }
    std::vector<ReliefChart> charts(count);
    for (ReliefChart& chart : charts) {
        const auto direction = reader.read<std::uint16_t>();
        chart.x = reader.read<std::uint16_t>();
        chart.y = reader.read<std::uint16_t>();
        chart.width = reader.read<std::uint16_t>();
        chart.height = reader.read<std::uint16_t>();
        const auto reserved = reader.read<std::uint16_t>();
        chart.u0_box = reader.read<float>();
        chart.v0_box = reader.read<float>();
        if (direction > static_cast<std::uint16_t>(ReliefDirection::MinusZ) || reserved != 0) {
            return bad_input("charts.direction",
                             "a chart has direction {} and reserved {}; allowed are 0 to 5 and 0", direction,
                             reserved);
        }
        chart.direction = static_cast<ReliefDirection>(direction);
    }
    return charts;
}

} // namespace frustumscreen::pack
