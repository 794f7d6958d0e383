/// A VIPER's session: every setting is sent, then read back. The confirmed frame rate gives the clock's tick.
/// The device's own filters add lag and are switched off; if they do not answer, the session asks three
/// times. If a filter stays on, or an answer is refused or has a warning, the device streams all the same and
/// the state says so.
///
/// Frame, units, time, threads: see device_session.h.
#pragma once

#include "firmware_host/tracker/set_up_progress.h"
#include "firmware_host/tracker/stream_buffer.h"
#include "firmware_host/tracker/viper_codec.h"

namespace frustumscreen::tracker {

class ViperSession final : public DeviceSession {
public:
    explicit ViperSession(const UsbTrackerSetUp& set_up);

    [[nodiscard]] std::span<const std::byte> due(MonotonicTime now) override;
    void receive(std::span<const std::byte> bytes, MonotonicTime arrival,
                 std::vector<PoseSample>& samples) override;
    [[nodiscard]] UsbTrackerState state(MonotonicTime now) const override;
    [[nodiscard]] bool failed() const override { return progress_.failed(); }
    [[nodiscard]] const SequenceChecker& intake() const override { return intake_; }

private:
    enum class Need {
        Ack,
        Same, ///< the answer must repeat the value set by the previous step
    };
    /// Consequence of a failed step.
    enum class Failing { TriesAgain, GoesOn };
    struct Step {
        ViperCommandBytes command;
        ViperCommand name;
        ViperAction action;
        Need need;
        Failing failing;
    };

    [[nodiscard]] static std::vector<Step> steps(const std::array<float, 3>& hemisphere);
    void answer(const ViperReply& reply, MonotonicTime now);
    void refused(const ViperReply& reply, MonotonicTime now);
    [[nodiscard]] bool repeats_what_was_set(const ViperReply& reply) const;
    [[nodiscard]] bool asks_filter_again();
    void fail_step(std::size_t back_to, UsbTrackerState trouble, MonotonicTime now);
    void try_again(std::size_t from, UsbTrackerState trouble);

    std::array<float, 3> hemisphere_;
    std::vector<Step> steps_;
    SetUpProgress progress_;
    bool filter_stays_on_ = false;
    int filter_unanswered_ = 0; ///< times, in this set-up
    bool doubtful_ = false;     ///< the device warned, or did not confirm a setting
    bool stream_stale_ = false; ///< the buffered bytes are useless; clear them with the next command
    StreamBuffer stream_;
    SequenceChecker intake_;
};

} // namespace frustumscreen::tracker
