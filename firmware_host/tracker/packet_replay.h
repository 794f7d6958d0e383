/// Plays a recording of packets through the sessions that the devices had, also as a tracker.
///
/// Frame    the device's; a SpaceMouse's is the table's.
/// Time     the replay runs on the recording's clock and gives exactly the samples that the exhibit had then.
///          The tracker maps them to our clock at any speed, as late as they came.
/// Threads  one caller.
#pragma once

#include "firmware_host/base/sentence.h"
#include "firmware_host/tracker/packet_file.h"

#include <memory>

namespace frustumscreen {

class PacketReplay {
public:
    /// `name` is the file in messages. Errors: no recording, or no device was found in it.
    [[nodiscard]] static Result<PacketReplay> open(Bytes file, std::string_view name);

    /// Plays what came up to `until`, on the recording's clock; appends the samples.
    void play(MonotonicTime until, std::vector<PoseSample>& samples);
    /// Back to the beginning.
    void rewind();

    [[nodiscard]] MonotonicTime begin() const { return begin_; }
    [[nodiscard]] MonotonicTime end() const { return end_; }
    [[nodiscard]] UsbTrackerModel model() const { return model_; } ///< of the first device
    [[nodiscard]] bool reports_table_frame() const { return model_ == UsbTrackerModel::SpaceMouse; }
    /// The tracker's state as the exhibit said it then; valid until the next `play`.
    [[nodiscard]] std::string_view state() const { return state_.view(); }
    /// What the sessions counted up to where it has played, in this round.
    [[nodiscard]] TrackerCounts counts() const;
    [[nodiscard]] std::uint64_t packets() const { return packets_; } ///< in the whole recording
    [[nodiscard]] std::uint64_t dropped() const { return dropped_; } ///< that the recorder had no room for
    [[nodiscard]] std::size_t left_bytes() const { return left_bytes_; } ///< behind a cut, or damage

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
    TrackerCounts counts_; ///< of the sessions that are over, and of what was opened
    MonotonicTime called_; ///< when the session was called last
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
    /// The recording begins at `start` and begins again when it has ended.
    PacketReplayTracker(PacketReplay replay, MonotonicTime start, double speed);

    [[nodiscard]] Result<void> poll(MonotonicTime now, std::vector<PoseSample>& samples) override;
    [[nodiscard]] std::string name() const override { return "replay"; }
    [[nodiscard]] bool reports_table_frame() const override { return replay_.reports_table_frame(); }
    [[nodiscard]] std::string_view state() const override { return replay_.state(); }
    [[nodiscard]] TrackerCounts counts() const override { return replay_.counts(); }

private:
    [[nodiscard]] MonotonicTime ours(MonotonicTime recorded) const;

    PacketReplay replay_;
    MonotonicTime start_; ///< of this round
    double speed_;
    Nanoseconds round_; ///< in our time
};

} // namespace frustumscreen
