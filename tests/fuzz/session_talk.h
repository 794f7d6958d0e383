/// Plays a session's device, from a script by the fuzzer, and checks the session's promises: poses are
/// finite, times never go back and are never in the future, every state has a sentence.
///
/// Script   u8 for the action, then its numbers, little-endian; after its end a script reads as zeros.
#pragma once

#include "firmware_host/base/byte_reader.h"
#include "firmware_host/tracker/device_session.h"
#include "tests/fuzz/stream_check.h"

namespace frustumscreen::fuzz {

class SessionTalk {
public:
    using Check = void (*)(const tracker::PoseSample&);
    /// `check` is also called for every sample.
    explicit SessionTalk(
        tracker::DeviceSession& session, Check check = [](const tracker::PoseSample&) {})
        : session_(session), check_(check) {
        ask();
    }

    /// The session's latest command; empty if it sent none.
    [[nodiscard]] const Bytes& command() const { return command_; }
    [[nodiscard]] bool over() const { return session_.failed() || wire_.size() > max_wire; }
    /// All delivered bytes.
    [[nodiscard]] const Bytes& wire() const { return wire_; }

    void wait(Nanoseconds duration) {
        now_ += duration;
        ask();
    }
    /// From now on bytes arrive in pieces of this size; 0: all at once.
    void cut(std::size_t piece) { piece_ = piece; }
    void deliver(std::span<const std::byte> bytes) {
        wire_.insert(wire_.end(), bytes.begin(), bytes.end());
        while (!bytes.empty()) {
            const std::size_t count = piece_ == 0 ? bytes.size() : std::min(piece_, bytes.size());
            samples_.clear();
            session_.receive(bytes.first(count), now_, samples_);
            bytes = bytes.subspan(count);
            check_samples();
        }
        ask();
    }

private:
    static constexpr std::size_t max_wire = 8192;

    void ask() {
        const std::span<const std::byte> due = session_.due(now_);
        if (!due.empty()) {
            require(!session_.failed(), "a session that failed sends nothing");
            command_.assign(due.begin(), due.end());
        }
        require(!tracker::sentence_of(session_.state(now_)).empty(), "a state has a sentence");
    }

    void check_samples() {
        for (const tracker::PoseSample& sample : samples_) {
            // Two frames of one arrival are set apart by a microsecond.
            early_ += std::chrono::microseconds(1);
            require(sample.time <= now_ + early_, "a sample is not from the future");
            require(!latest_ || *latest_ <= sample.time, "a sample's time does not go back");
            latest_ = sample.time;
            require(is_finite(sample.position_m) && is_unit(sample.rotation), "a pose is finite");
            require(tracker::is_pose(sample.position_m, sample.rotation), "a pose is near and a rotation");
            require(sample.station >= 1 && sample.station <= 128, "a station is numbered from 1");
            check_(sample);
        }
        const tracker::TrackerCounts counts = session_.intake().counts();
        require(counts.frames >= frames_ && counts.broken >= broken_, "counts do not go back");
        frames_ = counts.frames;
        broken_ = counts.broken;
    }

    tracker::DeviceSession& session_;
    Check check_;
    MonotonicTime now_ = from_microseconds(1'000'000'000);
    std::size_t piece_ = 0;
    Bytes command_;
    Bytes wire_;
    std::vector<tracker::PoseSample> samples_;
    std::optional<MonotonicTime> latest_;
    Nanoseconds early_{0};
    std::uint64_t frames_ = 0;
    std::uint64_t broken_ = 0;
};

/// The script's next bytes, at most `count`.
inline Bytes take(ByteReader& script, std::size_t count) {
    Bytes bytes;
    while (bytes.size() < count && script.left() > 0) {
        bytes.push_back(script.read<std::byte>());
    }
    return bytes;
}

/// A pose from few bytes of the script: mostly usable.
struct ScriptedPose {
    std::uint8_t step = 0;   ///< increment of the frame counter
    std::uint8_t sensor = 0; ///< counted from 0
    std::uint8_t distortion = 0;
    std::array<float, 3> position{}; ///< -8 to 8
    std::array<float, 4> quaternion{};

    explicit ScriptedPose(ByteReader& script)
        : step(script.read<std::uint8_t>()), sensor(script.read<std::uint8_t>() % 20),
          distortion(script.read<std::uint8_t>()) {
        for (float& number : position) {
            number = static_cast<float>(script.read<std::int16_t>()) / 4096.0F;
        }
        float squared = 0.0F;
        for (float& number : quaternion) {
            number = static_cast<float>(script.read<std::int8_t>());
            squared += number * number;
        }
        for (float& number : quaternion) {
            number /= std::sqrt(squared); // zeros become NaN, like from a broken device
        }
    }
};

} // namespace frustumscreen::fuzz
