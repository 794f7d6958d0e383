/// Which installed set to show, and the verdict on it: good, bad or still on trial.
///
/// Good     it was shown for `long_enough` without interruption and without a fault. A gap between reports longer
///          than `longest_silence` restarts the time.
/// Bad      one of its packs cannot be shown, or nothing can, or the exhibit began with it `max_starts` times
///          without a verdict. Then the previous set returns, if there is one.
/// Time     monotonic; the wall clock is not used, as it may be wrong. Time that goes back also restarts the time.
/// Threads  values; one caller.
/// Errors   none.
#pragma once

#include "app/library/installed_set.h"
#include "firmware_host/base/time.h"

#include <optional>
#include <string>

namespace frustumscreen::show {

enum class Trust : std::uint8_t {
    Newest,
    Before ///< the watchdog saw the newest fail: this run shows the one before, if there is one
};

class SetTrial {
public:
    static constexpr Nanoseconds long_enough = std::chrono::seconds(30);
    static constexpr Nanoseconds longest_silence = std::chrono::seconds(2);

    /// The exhibit starts. `verdict`: as kept; that of another set is ignored. `trust`: in the newest set.
    SetTrial(library::SetChoice choice, const std::optional<library::SetVerdict>& verdict,
             Trust trust = Trust::Newest);
    /// Takes another installed set, which is trusted, or the same set with another `last_good`. A set that is not
    /// trusted keeps the old `last_good` if there is no new one, so it does not return.
    void take(library::SetChoice choice);

    /// The set to show. This start is already counted, so `set_to_show` of the verdict refers to the next one.
    [[nodiscard]] const library::InstalledSet& target() const {
        const bool other = trust_ == Trust::Before || verdict_.state == library::TrialState::Bad ||
                           (on_trial() && !is_kept_);
        return other && choice_.last_good ? *choice_.last_good : choice_.set;
    }
    /// Tells whether the verdict could be written. The exhibit does not begin with a set on trial whose starts cannot
    /// be counted: the set might end the exhibit again and again.
    void note_kept(bool is_kept) { is_kept_ = is_kept; }
    /// The verdict to keep; write it before `target` is shown.
    [[nodiscard]] const library::SetVerdict& verdict() const { return verdict_; }
    /// The verdict to report: a set that is not trusted is bad for this run, whatever verdict is kept.
    [[nodiscard]] library::SetVerdict told() const;
    [[nodiscard]] const library::SetChoice& choice() const { return choice_; }
    /// True if there is another set to return to, and no verdict yet.
    [[nodiscard]] bool on_trial() const {
        return choice_.last_good.has_value() && verdict_.state == library::TrialState::Trying &&
               trust_ == Trust::Newest;
    }

    /// Reports that the set of this number is on show; `fault`: why it is bad, as a sentence; empty: no fault.
    void shown(MonotonicTime now, std::uint64_t number, const std::string& fault);
    /// Reports that the set of this number cannot be shown.
    void refuse(std::uint64_t number, const std::string& reason);

private:
    void begin();

    library::SetChoice choice_;
    library::SetVerdict verdict_;
    Trust trust_ = Trust::Newest;
    bool is_kept_ = true;
    std::optional<MonotonicTime> since_; ///< since when it has been on show without interruption
    MonotonicTime latest_;               ///< time of the latest report
};

} // namespace frustumscreen::show
