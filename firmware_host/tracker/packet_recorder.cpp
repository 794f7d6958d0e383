#include "firmware_host/tracker/packet_recorder.h"

#include <fmt/format.h>

namespace frustumscreen {

namespace {

constexpr Nanoseconds between_writes = std::chrono::milliseconds(250);
constexpr Nanoseconds between_syncs = std::chrono::seconds(1);
constexpr std::size_t room_for_gap = 64; ///< for the packet that names a gap

} // namespace

PacketRecorder::PacketRecorder(GrowingFile file, std::string_view about, MonotonicTime now)
    : file_(std::move(file)), said_(fmt::format("the tracker is recorded to {}", file_.path().string())) {
    waiting_.reserve(most_waiting_bytes);
    append_packet_header(waiting_);
    take(PacketKind::About, now, as_bytes(about));
    thread_ = std::jthread([this](const std::stop_token& stop) { write(stop); });
}

bool PacketRecorder::has_room(std::size_t payload) const {
    return payload <= longest_packet &&
           waiting_.size() + packet_size(payload) + room_for_gap <= most_waiting_bytes;
}

void PacketRecorder::take(PacketKind kind, MonotonicTime time, std::span<const std::byte> payload) {
    append_packet(waiting_, {kind, time, payload});
    ++counts_.packets;
}

void PacketRecorder::packet(PacketKind kind, MonotonicTime time, std::span<const std::byte> payload) {
    const std::lock_guard lock(mutex_);
    if (ended_) {
        return;
    }
    if (!has_room(payload.size())) {
        ++counts_.dropped;
        ++gap_;
        return;
    }
    if (gap_ > 0) {
        take(PacketKind::Dropped, time, std::as_bytes(std::span(&gap_, 1)));
        gap_ = 0;
    }
    take(kind, time, payload);
}

void PacketRecorder::write(const std::stop_token& stop) {
    Bytes writing;
    writing.reserve(most_waiting_bytes);
    MonotonicTime synced = monotonic_now();
    std::uint64_t dropped = 0;
    bool last = false;
    while (!last) {
        {
            std::unique_lock lock(mutex_);
            something_waits_.wait_for(lock, stop, between_writes, [] { return false; });
            last = stop.stop_requested();
            writing.clear();
            writing.swap(waiting_);
            if (counts_.dropped > dropped) {
                dropped = counts_.dropped;
                said_.set(fmt::format(
                    "the tracker is recorded to {}, but the disk is too slow: {} packets are missing",
                    file_.path().string(), dropped));
            }
        }
        if (Result<void> written = file_.append(writing); !written) {
            const std::lock_guard lock(mutex_);
            said_.set(fmt::format("the recording has ended; {}", written.error().message));
            ended_ = std::move(written.error());
            return;
        }
        if (last || monotonic_now() - synced > between_syncs) {
            file_.sync();
            synced = monotonic_now();
        }
    }
}

std::string_view PacketRecorder::state() {
    said_.read(read_);
    return read_.view();
}

Result<void> PacketRecorder::finish() {
    if (thread_.joinable()) {
        thread_.request_stop();
        thread_.join();
    }
    const std::lock_guard lock(mutex_);
    return ended_ ? Result<void>(tl::unexpected(*ended_)) : Result<void>();
}

PacketRecorder::Counts PacketRecorder::counts() const {
    const std::lock_guard lock(mutex_);
    return counts_;
}

} // namespace frustumscreen
