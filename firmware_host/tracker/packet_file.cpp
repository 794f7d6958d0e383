#include "firmware_host/tracker/packet_file.h"

#include "firmware_host/base/byte_reader.h"
#include "firmware_host/tracker/crc.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>

namespace frustumscreen::tracker {

namespace {

constexpr std::array<char, 8> magic{'F', 'S', 'P', 'A', 'C', 'K', 'E', 'T'};
constexpr std::uint32_t version = 1;
constexpr std::size_t header_bytes = 16;
constexpr std::size_t head_bytes = 16;
constexpr std::size_t crc_bytes = 4;
/// About 140 years; sums with it do not overflow.
constexpr std::int64_t latest_time_ns = std::int64_t{1} << 62;

bool known(std::uint32_t kind) {
    return kind >= static_cast<std::uint32_t>(PacketKind::About) &&
           kind <= static_cast<std::uint32_t>(PacketKind::Dropped);
}

} // namespace

bool is_packet_recording(std::span<const std::byte> file) {
    return file.size() >= magic.size() && std::memcmp(file.data(), magic.data(), magic.size()) == 0;
}

void append_packet_header(Bytes& file) {
    append(file, magic);
    append(file, version);
    append(file, std::uint32_t{0});
}

void append_packet(Bytes& file, const Packet& packet) {
    assert(packet.payload.size() <= longest_packet);
    const std::size_t begin = file.size();
    append(file, static_cast<std::uint32_t>(packet.payload.size()));
    append(file, static_cast<std::uint32_t>(packet.kind));
    append(file, static_cast<std::int64_t>(packet.time.time_since_epoch().count()));
    file.insert(file.end(), packet.payload.begin(), packet.payload.end());
    append(file, crc32_ieee(std::span<const std::byte>(file).subspan(begin)));
}

std::size_t packet_size(std::size_t payload) {
    return head_bytes + payload + crc_bytes;
}

Result<PacketReader> PacketReader::open(std::span<const std::byte> file, std::string_view name) {
    if (!is_packet_recording(file) || file.size() < header_bytes) {
        return bad_input("packets.no_recording",
                         "{}: this is not a recording of packets; frustumscreen record --raw makes one",
                         name);
    }
    const auto found = ByteReader(file.subspan(magic.size())).read<std::uint32_t>();
    if (found != version) {
        return bad_input("packets.version",
                         "{}: this recording has version {}; this program reads version {}", name, found,
                         version);
    }
    return PacketReader(file.subspan(header_bytes));
}

std::optional<Packet> PacketReader::next() {
    while (true) {
        ByteReader reader(rest_);
        const auto size = reader.read<std::uint32_t>();
        const auto kind = reader.read<std::uint32_t>();
        const auto time_ns = reader.read<std::int64_t>();
        if (!reader.ok() || size > longest_packet || reader.left() < size + crc_bytes) {
            return std::nullopt;
        }
        const std::size_t before_crc = head_bytes + size;
        const auto crc = ByteReader(rest_.subspan(before_crc)).read<std::uint32_t>();
        if (crc != crc32_ieee(rest_.first(before_crc))) {
            return std::nullopt;
        }
        const std::span<const std::byte> payload = rest_.subspan(head_bytes, size);
        rest_ = rest_.subspan(before_crc + crc_bytes);
        latest_ns_ = std::clamp(time_ns, latest_ns_, latest_time_ns);
        if (known(kind)) {
            return Packet{static_cast<PacketKind>(kind), MonotonicTime(Nanoseconds(latest_ns_)), payload};
        }
    }
}

} // namespace frustumscreen::tracker
