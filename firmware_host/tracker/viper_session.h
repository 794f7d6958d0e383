/// A VIPER's session: every setting is sent, then read back; the frame rate so confirmed is the clock's tick.
///
/// Frame, units, time, threads: see device_session.h.
#pragma once

#include "firmware_host/tracker/device_session.h"
#include "firmware_host/tracker/stream_buffer.h"
#include "firmware_host/tracker/viper_codec.h"

namespace frustumscreen {

class ViperSession final : public DeviceSession {
public:
    explicit ViperSession(const UsbTrackerSetUp& set_up);

    [[nodiscard]] std::span<const std::byte> due(MonotonicTime now) override;
    void receive(std::span<const std::byte> bytes, MonotonicTime arrival,
                 std::vector<PoseSample>& samples) override;
    [[nodiscard]] UsbTrackerState state(MonotonicTime now) const override;
    [[nodiscard]] bool failed() const override { return failed_; }
    [[nodiscard]] const FrameIntake& intake() const override { return intake_; }

private:
    enum class Need {
        Try, ///< an answer is welcome; without one, or with a refusal, the set-up goes on
        Ack,
        Same, ///< the answer must repeat what was set
    };
    struct Step {
        ViperCommandBytes command;
        ViperCommand name;
        Need need;
        std::size_t set_by = 0; ///< Same: the step that set it, to go back to
    };

    void answer(const ViperReply& reply, MonotonicTime now);
    [[nodiscard]] bool repeats_what_was_set(const ViperReply& reply) const;
    void next();
    void try_again(std::size_t from, UsbTrackerState trouble);
    [[nodiscard]] bool streaming() const { return at_ == steps_.size(); }

    std::array<float, 3> hemisphere_;
    std::vector<Step> steps_;
    std::size_t at_ = 0;
    int tries_ = 0;
    std::optional<MonotonicTime> sent_;  ///< the step's command; waiting for its answer
    std::optional<MonotonicTime> pause_; ///< nothing is sent before
    std::optional<MonotonicTime> awake_; ///< streaming was asked for
    UsbTrackerState trouble_ = UsbTrackerState::SettingUp;
    bool failed_ = false;
    bool stream_stale_ = false; ///< what came before is worth nothing; cleared with the next command
    StreamBuffer stream_;
    FrameIntake intake_;
};

} // namespace frustumscreen
