#include "firmware_host/tracker/packet_recorder.h"

#include "firmware_host/base/device_thread.h"
#include "firmware_host/base/format_sentence.h"

#include <bit>

namespace frustumscreen::tracker {

namespace {

constexpr Nanoseconds between_writes = std::chrono::milliseconds(250);
constexpr Nanoseconds between_syncs = std::chrono::seconds(1);
constexpr std::size_t space_for_gap = 64; ///< for the packet that records a gap

} // namespace

PacketRecorder::PacketRecorder(GrowingFile file, std::string_view about, MonotonicTime now)
    : file_(std::move(file)) {
    say();
    waiting_.reserve(max_waiting_bytes);
    append_packet_header(waiting_);
    take(PacketKind::About, now, as_bytes(about));
    thread_ = std::jthread([this](const std::stop_token& stop) { write(stop); });
}

bool PacketRecorder::has_space(std::size_t payload) const {
    return payload <= longest_packet &&
           waiting_.size() + packet_size(payload) + space_for_gap <= max_waiting_bytes;
}

void PacketRecorder::take(PacketKind kind, MonotonicTime time, std::span<const std::byte> payload) {
    append_packet(waiting_, {kind, time, payload});
    ++counts_.packets;
}

void PacketRecorder::packet(PacketKind kind, MonotonicTime time, std::span<const std::byte> payload) {
    const std::lock_guard lock(mutex_);
    if (finished_) {
        return;
    }
    if (!has_space(payload.size())) {
        ++counts_.dropped;
        ++gap_;
        gap_until_ = time;
        return;
    }
    name_gap(time);
    take(kind, time, payload);
}

void PacketRecorder::name_gap(MonotonicTime time) {
    if (gap_ > 0) {
        take(PacketKind::Dropped, time, std::as_bytes(std::span(&gap_, 1)));
        gap_ = 0;
    }
}

void PacketRecorder::write(const std::stop_token& stop) {
    begin_device_thread("recorder");
    Bytes writing;
    writing.reserve(max_waiting_bytes);
    MonotonicTime synced = monotonic_now();
    bool last = false;
    while (!last) {
        sleep_until_stop(stop, between_writes);
        {
            const std::lock_guard lock(mutex_);
            last = stop.stop_requested();
            if (last) {
                name_gap(gap_until_);
            }
            writing.clear();
            writing.swap(waiting_);
        }
        Result<void> written = file_.append(writing);
        if (written && (last || monotonic_now() - synced > between_syncs)) {
            written = file_.sync();
            synced = monotonic_now();
        }
        if (!written) {
            const std::lock_guard lock(mutex_);
            ended_ = std::move(written.error());
            finished_ = true;
            return;
        }
    }
}

void PacketRecorder::say() {
    const std::string& path = file_.path().native();
    if (ended_) {
        said_ = format_sentence("the recording has ended; {}", ended_->message);
    } else if (counts_.dropped > 0) {
        said_ = format_sentence(
            "the tracker is recorded to {}, but the disk is too slow: {} or more packets are missing", path,
            std::bit_floor(counts_.dropped));
    } else {
        said_ = format_sentence("the tracker is recorded to {}", path);
    }
}

/// Never waits for the disk: the writing thread holds the lock no longer than a swap takes.
std::string_view PacketRecorder::state() {
    if (const std::unique_lock lock(mutex_, std::try_to_lock); lock.owns_lock()) {
        say();
    }
    return said_.view();
}

Result<void> PacketRecorder::finish() {
    {
        const std::lock_guard lock(mutex_);
        finished_ = true;
    }
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

} // namespace frustumscreen::tracker
