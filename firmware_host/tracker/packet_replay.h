/// Plays a recording of packets through the sessions that the devices had; also as a tracker.
///
/// Frame    the device's; the table's for a SpaceMouse.
/// Time     the replay runs on the recording's clock and gives exactly the samples that the exhibit received.
///          The tracker maps them to our clock at any speed, with their original delays.
/// Threads  one caller.
#pragma once

#include "firmware_host/base/sentence.h"
#include "firmware_host/tracker/packet_file.h"

#include <memory>

namespace frustumscreen::tracker {

class PacketReplay {
public:
    /// `name` names the file in messages. Errors: not a recording, or no device in it.
    [[nodiscard]] static Result<PacketReplay> open(Bytes file, std::string_view name);

    /// Plays the packets up to `until`, on the recording's clock; appends the samples.
    void play(MonotonicTime until, std::vector<PoseSample>& samples);
    /// Back to the beginning.
    void rewind();

    [[nodiscard]] MonotonicTime begin() const { return begin_; }
    [[nodiscard]] MonotonicTime end() const { return end_; }
    [[nodiscard]] UsbTrackerModel model() const { return model_; } ///< of the first device
    [[nodiscard]] bool reports_table_frame() const { return model_ == UsbTrackerModel::SpaceMouse; }
    /// The tracker's state as recorded; valid until the next `play`.
    [[nodiscard]] std::string_view state() const { return state_.view(); }
    /// Counts of the sessions up to the current position in this round.
    [[nodiscard]] TrackerCounts counts() const;
    [[nodiscard]] std::uint64_t packets() const { return packets_; }     ///< in the whole recording
    [[nodiscard]] std::uint64_t dropped() const { return dropped_; }     ///< missing in the recording
    [[nodiscard]] std::size_t left_bytes() const { return left_bytes_; } ///< after a truncation or damage

private:
    PacketReplay(Bytes file, const PacketReader& packets)
        : file_(std::move(file)), first_(packets), rest_(packets) {}
    [[nodiscard]] bool survey();
    void end_session();
    void feed(const Packet& packet, std::vector<PoseSample>& samples);

    Bytes file_; ///< its heap memory stays in place when this moves
    PacketReader first_;
    PacketReader rest_;
    std::optional<Packet> next_;
    std::unique_ptr<DeviceSession> session_;
    TrackerCounts counts_; ///< of the finished sessions, and the connections
    MonotonicTime called_; ///< time of the last call to the session
    MonotonicTime begin_;
    MonotonicTime end_;
    UsbTrackerModel model_ = UsbTrackerModel::Viper;
    Sentence state_;
    std::uint64_t packets_ = 0;
    std::uint64_t dropped_ = 0;
    std::size_t left_bytes_ = 0;
};

class PacketReplayTracker final : public Tracker {
public:
    /// The recording begins at `start` and repeats.
    PacketReplayTracker(PacketReplay replay, MonotonicTime start, double speed);

    [[nodiscard]] Result<void> poll(MonotonicTime now, std::vector<PoseSample>& samples) override;
    [[nodiscard]] std::string name() const override { return "replay"; }
    [[nodiscard]] bool reports_table_frame() const override { return replay_.reports_table_frame(); }
    [[nodiscard]] std::string_view state() const override { return replay_.state(); }
    [[nodiscard]] TrackerCounts counts() const override { return replay_.counts(); }

private:
    [[nodiscard]] MonotonicTime ours(MonotonicTime recorded) const;

    PacketReplay replay_;
    MonotonicTime start_; ///< start of this round
    double speed_;
    Nanoseconds round_; ///< length of a round, in our time
};

} // namespace frustumscreen::tracker
