/// Recordings of a tracker's packets; docs/packet_recording.md specifies every byte.
///
/// Errors   a truncated or damaged recording is played up to that place; only a wrong header is an error.
/// Threads  pure; any. The bytes must outlive the reader.
#pragma once

#include "firmware_host/base/file.h"
#include "firmware_host/tracker/packet_tap.h"

#include <string_view>

namespace frustumscreen::tracker {

inline constexpr std::size_t longest_packet = std::size_t{1} << 16;

struct Packet {
    PacketKind kind = PacketKind::Received; ///< the reader skips unknown kinds of later versions
    MonotonicTime time;                     ///< ascending or equal
    std::span<const std::byte> payload;
};

/// Whether `file` begins like a packet recording of any version.
[[nodiscard]] bool is_packet_recording(std::span<const std::byte> file);

void append_packet_header(Bytes& file);
/// `payload` is at most `longest_packet`.
void append_packet(Bytes& file, const Packet& packet);
/// Bytes that `append_packet` appends.
[[nodiscard]] std::size_t packet_size(std::size_t payload);

class PacketReader {
public:
    /// `name` names the file in messages.
    [[nodiscard]] static Result<PacketReader> open(std::span<const std::byte> file, std::string_view name);

    /// The next packet; nullopt at the end, or at a truncated or damaged place.
    [[nodiscard]] std::optional<Packet> next();
    /// Bytes that were not read as packets; 0 at the end of an intact recording.
    [[nodiscard]] std::size_t left() const { return rest_.size(); }

private:
    explicit PacketReader(std::span<const std::byte> packets) : rest_(packets) {}

    std::span<const std::byte> rest_;
    std::int64_t latest_ns_ = 0;
};

} // namespace frustumscreen::tracker
