/// Which installed set is to be shown, and what has been seen of it: good, bad or not known yet.
///
/// Good     it was shown for `long_enough` in one piece, without a fault. A break in what is told of it, longer than
///          `longest_silence`, begins the time anew.
/// Bad      one of its packs cannot be shown, or it can show nothing at all, or the exhibit began with it `max_starts` times and
///          came to no verdict. The set before comes back then, if there is one.
/// Time     monotonic; the wall's clock is never asked, as it may be wrong. Time that goes back begins anew, too.
/// Threads  values; one caller.
/// Errors   none.
#pragma once

#include "app/library/installed_set.h"
#include "firmware_host/base/time.h"

#include <optional>
#include <string>

namespace frustumscreen {

enum class Trust : std::uint8_t {
    Newest,
    Before ///< the watchdog saw no good come of the newest: for this run the one before is shown, if there is one
};

class SetTrial {
public:
    static constexpr Nanoseconds long_enough = std::chrono::seconds(30);
    static constexpr Nanoseconds longest_silence = std::chrono::seconds(2);

    /// The exhibit starts. `verdict`: as it was left; of another set it says nothing. `trust`: in the newest set.
    SetTrial(SetChoice choice, const std::optional<SetVerdict>& verdict, Trust trust = Trust::Newest);
    /// Something else was installed, which is trusted, or the same is without `last_good` now: nothing is lost then. A set that is
    /// not trusted does not come back by that.
    void take(SetChoice choice);

    /// To show now. This start is counted already, so that `set_to_show` of the verdict is about the next one.
    [[nodiscard]] const InstalledSet& target() const {
        const bool other =
            trust_ == Trust::Before || verdict_.state == TrialState::Bad || (on_trial() && !is_kept_);
        return other && choice_.last_good ? *choice_.last_good : choice_.set;
    }
    /// Whether the verdict could be written. A set on trial whose starts cannot be counted is not begun with: it might end the
    /// exhibit again and again.
    void note_kept(bool is_kept) { is_kept_ = is_kept; }
    /// To keep; written before `target` is shown.
    [[nodiscard]] const SetVerdict& verdict() const { return verdict_; }
    /// To tell: a set that is not trusted is bad for this run, whatever is kept of it.
    [[nodiscard]] SetVerdict told() const;
    [[nodiscard]] const SetChoice& choice() const { return choice_; }
    /// There is another set to go back to, and no verdict.
    [[nodiscard]] bool on_trial() const {
        return choice_.last_good.has_value() && verdict_.state == TrialState::Trying &&
               trust_ == Trust::Newest;
    }

    /// The set of this number is on show now; `fault`: why it is not good, a sentence; empty: there is none.
    void shown(MonotonicTime now, std::uint64_t number, const std::string& fault);
    /// The set of this number cannot be shown.
    void refuse(std::uint64_t number, const std::string& reason);

private:
    void begin();

    SetChoice choice_;
    SetVerdict verdict_;
    Trust trust_ = Trust::Newest;
    bool is_kept_ = true;
    std::optional<MonotonicTime> since_; ///< it has been on show in one piece
    MonotonicTime latest_;               ///< when that was told
};

} // namespace frustumscreen
