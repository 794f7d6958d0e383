/// Recordings of a tracker's packets; docs/packet_recording.md has every byte.
///
/// Errors   a recording that was cut off, or damaged, is played up to there; only a wrong beginning is an
///          error.
/// Threads  pure; any. The bytes must outlive the reader.
#pragma once

#include "firmware_host/base/file.h"
#include "firmware_host/tracker/packet_tap.h"

#include <string_view>

namespace frustumscreen {

inline constexpr std::size_t longest_packet = std::size_t{1} << 16;

struct Packet {
    PacketKind kind = PacketKind::Received; ///< the reader skips kinds of later versions
    MonotonicTime time;                     ///< never earlier than the packet before
    std::span<const std::byte> payload;
};

/// Whether `file` begins like a recording of any version.
[[nodiscard]] bool is_packet_recording(std::span<const std::byte> file);

void append_packet_header(Bytes& file);
/// `payload` is at most `longest_packet`.
void append_packet(Bytes& file, const Packet& packet);
/// Bytes that `append_packet` appends.
[[nodiscard]] std::size_t packet_size(std::size_t payload);

class PacketReader {
public:
    /// `name` is the file in the message.
    [[nodiscard]] static Result<PacketReader> open(std::span<const std::byte> file, std::string_view name);

    /// The next packet; nothing at the end, or where the recording is cut off or damaged.
    [[nodiscard]] std::optional<Packet> next();
    /// Bytes that were not read as packets; 0 at the end of a whole recording.
    [[nodiscard]] std::size_t left() const { return rest_.size(); }

private:
    explicit PacketReader(std::span<const std::byte> packets) : rest_(packets) {}

    std::span<const std::byte> rest_;
    std::int64_t latest_ns_ = 0;
};

} // namespace frustumscreen
