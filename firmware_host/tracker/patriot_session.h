/// A PATRIOT's or LIBERTY's session: text for the set-up, the units read back, then binary frames.
///
/// These devices answer questions, but not a command that they accept. Settings other than the units are
/// verified by the frames: the size is that of the chosen fields, and the quaternion has length 1. Frame,
/// units, time, threads: see device_session.h.
#pragma once

#include "firmware_host/tracker/device_session.h"
#include "firmware_host/tracker/patriot_codec.h"
#include "firmware_host/tracker/set_up_progress.h"
#include "firmware_host/tracker/stream_buffer.h"

#include <string>

namespace frustumscreen::tracker {

class PatriotSession final : public DeviceSession {
public:
    explicit PatriotSession(const UsbTrackerSetUp& set_up);

    [[nodiscard]] std::span<const std::byte> due(MonotonicTime now) override;
    void receive(std::span<const std::byte> bytes, MonotonicTime arrival,
                 std::vector<PoseSample>& samples) override;
    [[nodiscard]] UsbTrackerState state(MonotonicTime now) const override {
        return progress_.state(now, intake_);
    }
    [[nodiscard]] bool failed() const override { return progress_.failed(); }
    [[nodiscard]] const SequenceChecker& intake() const override { return intake_; }

private:
    enum class Need { Nothing, AnyText, Metric };
    struct Step {
        std::string command;
        Need need = Need::Nothing;
    };

    [[nodiscard]] static std::vector<Step> steps(const UsbTrackerSetUp& set_up);
    void read_answer(MonotonicTime now);
    void read_frames(MonotonicTime arrival, std::vector<PoseSample>& samples);

    std::vector<Step> steps_;
    SetUpProgress progress_;
    StreamBuffer stream_;
    SequenceChecker intake_;
};

} // namespace frustumscreen::tracker
