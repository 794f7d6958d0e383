/// How far a device's set-up is: which step, whether it waits for an answer, what went wrong last.
///
/// Time     a parameter throughout.
/// Threads  values; one caller.
#pragma once

#include "firmware_host/tracker/device_session.h"

#include <algorithm>

namespace frustumscreen {

class SetUpProgress {
public:
    /// `steps`: after so many the device streams.
    explicit SetUpProgress(std::size_t steps) : steps_(steps) {}

    [[nodiscard]] std::size_t step() const { return step_; }
    [[nodiscard]] bool streaming() const { return step_ == steps_; }
    [[nodiscard]] bool failed() const { return failed_; }
    [[nodiscard]] bool waits_for_answer() const { return sent_.has_value(); }
    /// It streams, and nothing was heard for too long.
    [[nodiscard]] bool silent(MonotonicTime now, const FrameIntake& intake) const {
        return streaming() && now - std::max(intake.latest().value_or(awake_), awake_) > intake.patience();
    }
    [[nodiscard]] bool unanswered(MonotonicTime now) const {
        return sent_ && now - *sent_ > SessionTimes::reply;
    }
    /// The step's command is due.
    [[nodiscard]] bool may_send(MonotonicTime now) const {
        return !failed_ && !sent_ && !streaming() && now >= pause_;
    }
    /// What to say about a device that did not answer.
    [[nodiscard]] UsbTrackerState trouble_without_answer() const {
        return trouble_ == UsbTrackerState::SettingUp ? UsbTrackerState::SetUpRefused : trouble_;
    }
    [[nodiscard]] UsbTrackerState state(MonotonicTime now, const FrameIntake& intake) const {
        const bool heard = streaming() && intake.latest() && *intake.latest() >= awake_;
        return heard ? intake.state(now) : trouble_;
    }

    /// The step's command was sent, and is to be answered.
    void sent(MonotonicTime now) { sent_ = now; }
    /// The step is done; the next command not before `pause` has passed.
    void next(MonotonicTime now, Nanoseconds pause = {}) {
        ++step_;
        sent_.reset();
        pause_ = now + pause;
        awake_ = now;
    }
    /// Does the same step again later; this does not count as a try.
    void put_off(UsbTrackerState why, MonotonicTime until) {
        sent_.reset();
        trouble_ = why;
        pause_ = until;
    }
    void try_again(std::size_t from, UsbTrackerState trouble) {
        step_ = from;
        sent_.reset();
        trouble_ = trouble;
        failed_ = ++tries_ >= SessionTimes::tries;
    }
    /// A frame came as it should: resets the tries and the last trouble.
    void well() {
        tries_ = 0;
        trouble_ = UsbTrackerState::SettingUp;
    }

private:
    std::size_t steps_;
    std::size_t step_ = 0;
    int tries_ = 0;
    std::optional<MonotonicTime> sent_; ///< the step's command
    MonotonicTime pause_{};             ///< nothing is sent before
    MonotonicTime awake_{};             ///< when the last step was done
    UsbTrackerState trouble_ = UsbTrackerState::SettingUp;
    bool failed_ = false;
};

} // namespace frustumscreen
