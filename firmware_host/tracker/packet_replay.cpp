#include "firmware_host/tracker/packet_replay.h"

#include "firmware_host/base/byte_reader.h"
#include "firmware_host/tracker/replay_speed.h"

#include <fmt/format.h>

#include <algorithm>

namespace frustumscreen::tracker {

namespace {

/// Pause between two rounds; it also keeps the shortest round above 0.
constexpr Nanoseconds between_rounds = std::chrono::seconds(1);

} // namespace

Result<PacketReplay> PacketReplay::open(Bytes file, std::string_view name) {
    TRY(const PacketReader packets, PacketReader::open(file, name));
    PacketReplay replay(std::move(file), packets);
    if (!replay.survey()) {
        return bad_input("packets.no_tracker", "{}: no tracker was found while this was recorded", name);
    }
    replay.rewind();
    return replay;
}

/// Returns false if the recording has no device.
bool PacketReplay::survey() {
    PacketReader reader = first_;
    std::optional<UsbTrackerModel> model;
    while (const std::optional<Packet> packet = reader.next()) {
        begin_ = packets_ == 0 ? packet->time : begin_;
        end_ = packet->time;
        ++packets_;
        if (packet->kind == PacketKind::Opened && !model) {
            const std::optional<OpenedDevice> opened = OpenedDevice::from(packet->payload);
            model = opened ? std::optional(opened->model) : std::nullopt;
        } else if (packet->kind == PacketKind::Dropped) {
            dropped_ += ByteReader(packet->payload).read<std::uint64_t>();
        }
    }
    left_bytes_ = reader.left();
    model_ = model.value_or(UsbTrackerModel::Viper);
    return model.has_value();
}

void PacketReplay::rewind() {
    rest_ = first_;
    next_ = rest_.next();
    session_.reset();
    counts_ = {};
    state_ = Sentence(sentence_of(UsbTrackerState::NotConnected));
}

void PacketReplay::end_session() {
    counts_ = counts();
    session_.reset();
}

TrackerCounts PacketReplay::counts() const {
    TrackerCounts counts = counts_;
    if (session_) {
        counts += session_->intake().counts();
    }
    return counts;
}

/// As in the recorded run, `due` is called before each `receive`: with the time of the packet if a command
/// was sent then, otherwise with the latest time at which certainly none was due.
void PacketReplay::feed(const Packet& packet, std::vector<PoseSample>& samples) {
    switch (packet.kind) {
    case PacketKind::Opened: {
        const std::optional<OpenedDevice> opened = OpenedDevice::from(packet.payload);
        end_session();
        ++counts_.connections;
        session_ = opened ? make_session(opened->model, opened->set_up) : nullptr;
        break;
    }
    case PacketKind::Closed:
        end_session();
        break;
    case PacketKind::Sent:
        if (session_) {
            static_cast<void>(session_->due(packet.time));
        }
        break;
    case PacketKind::Received:
        if (session_) {
            static_cast<void>(session_->due(called_));
            session_->receive(packet.payload, packet.time, samples);
        }
        break;
    case PacketKind::State:
        state_ = Sentence(as_text(packet.payload));
        break;
    case PacketKind::About:
    case PacketKind::Dropped:
        break;
    }
    called_ = packet.time;
}

void PacketReplay::play(MonotonicTime until, std::vector<PoseSample>& samples) {
    for (; next_ && next_->time <= until; next_ = rest_.next()) {
        feed(*next_, samples);
    }
}

PacketReplayTracker::PacketReplayTracker(PacketReplay replay, MonotonicTime start, double speed)
    : replay_(std::move(replay)), start_(start), speed_(speed),
      round_(scaled(replay_.end() - replay_.begin(), 1.0 / speed) + between_rounds) {}

MonotonicTime PacketReplayTracker::ours(MonotonicTime recorded) const {
    return start_ + scaled(recorded - replay_.begin(), 1.0 / speed_);
}

Result<void> PacketReplayTracker::poll(MonotonicTime now, std::vector<PoseSample>& samples) {
    const std::size_t before = samples.size();
    if (now - start_ >= round_) { // skip whole rounds that no poll saw
        start_ += ((now - start_) / round_) * round_;
        replay_.rewind();
    }
    replay_.play(replay_.begin() + scaled(now - start_, speed_), samples);
    for (std::size_t k = before; k < samples.size(); ++k) {
        samples[k].time = std::min(ours(samples[k].time), now);
    }
    return {};
}

} // namespace frustumscreen::tracker
