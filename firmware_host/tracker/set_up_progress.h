/// Progress of a device's set-up: the current step, whether it waits for an answer, and the last trouble.
///
/// Time     a parameter throughout.
/// Threads  values; one caller.
#pragma once

#include "firmware_host/tracker/device_session.h"

#include <algorithm>

namespace frustumscreen::tracker {

class SetUpProgress {
public:
    /// The device streams after `steps` steps.
    explicit SetUpProgress(std::size_t steps) : steps_(steps) {}

    [[nodiscard]] std::size_t step() const { return step_; }
    [[nodiscard]] bool streaming() const { return step_ == steps_; }
    [[nodiscard]] bool failed() const { return failed_; }
    [[nodiscard]] bool waits_for_answer() const { return sent_.has_value(); }
    /// The device should stream, but has been silent for too long.
    [[nodiscard]] bool silent(MonotonicTime now, const SequenceChecker& intake) const {
        return streaming() && now - std::max(intake.latest().value_or(awake_), awake_) > intake.timeout();
    }
    [[nodiscard]] bool unanswered(MonotonicTime now) const {
        return sent_ && now - *sent_ > SessionTimes::reply;
    }
    /// The current step's command is due.
    [[nodiscard]] bool may_send(MonotonicTime now) const {
        return !failed_ && !sent_ && !streaming() && now >= pause_;
    }
    /// The state to report for a device that did not answer.
    [[nodiscard]] UsbTrackerState trouble_without_answer() const {
        return trouble_ == UsbTrackerState::SettingUp ? UsbTrackerState::SetUpRefused : trouble_;
    }
    [[nodiscard]] UsbTrackerState state(MonotonicTime now, const SequenceChecker& intake) const {
        const bool heard = streaming() && intake.latest() && *intake.latest() >= awake_;
        return heard ? intake.state(now) : trouble_;
    }

    /// The step's command was sent; wait for an answer.
    void sent(MonotonicTime now) { sent_ = now; }
    /// The step is done; the next command is not sent before `pause` has passed.
    void next(MonotonicTime now, Nanoseconds pause = {}) {
        ++step_;
        sent_.reset();
        pause_ = now + pause;
        awake_ = now;
    }
    /// Repeats the current step at `until`, without counting it as a try.
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
    /// A good frame came: resets the tries and the last trouble.
    void well() {
        tries_ = 0;
        trouble_ = UsbTrackerState::SettingUp;
    }

private:
    std::size_t steps_;
    std::size_t step_ = 0;
    int tries_ = 0;
    std::optional<MonotonicTime> sent_; ///< time of the step's command
    MonotonicTime pause_{};             ///< no command is sent before this time
    MonotonicTime awake_{};             ///< time at which the last step was done
    UsbTrackerState trouble_ = UsbTrackerState::SettingUp;
    bool failed_ = false;
};

} // namespace frustumscreen::tracker
