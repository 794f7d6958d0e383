#include "tests/simulators/museum/museum.h"

#include "app/watch/judge.h"

#include <algorithm>
#include <optional>
#include <random>

namespace frustumscreen::simulators {

namespace {

constexpr MuseumTime between_reboots_s = 120;
constexpr MuseumTime well_for_s = 60; ///< before a step that counts as a false alarm
constexpr double loads_a_day = 4.0;
constexpr MuseumTime load_s = 600;

MonotonicTime monotonic(MuseumTime time) {
    return MonotonicTime(std::chrono::seconds(time));
}
watch::Awake awake(MuseumTime time) {
    return std::chrono::seconds(time);
}

/// Other programs occupy the machine for ten minutes: checks and statuses come late.
class Load {
public:
    explicit Load(std::uint64_t seed) : chance_(seed) {}
    /// True if the watchdog runs in this second.
    bool lets_look(MuseumTime now) {
        if (now >= next_ + load_s) {
            next_ = now + 1 +
                    static_cast<MuseumTime>(
                        std::exponential_distribution<double>(loads_a_day / museum_day)(chance_));
        }
        is_on_ = now >= next_;
        return !is_on_ || chance_() % 3 == 0;
    }
    Nanoseconds status_age() { return std::chrono::milliseconds(is_on_ ? chance_() % 3500 : 0); }

private:
    std::mt19937_64 chance_;
    MuseumTime next_ = 0;
    bool is_on_ = false;
};

/// The judge with one of the policies. At a boot it loses everything except the ladder's memory.
class Keeper {
public:
    explicit Keeper(Policy policy) : policy_(policy) {}

    void boot(MuseumTime now) {
        ladder_ = watch::Ladder(ladder_.memory(), true);
        judge_ = watch::Judge(watch::Timeouts{}, monotonic(now));
    }
    [[nodiscard]] watch::Mode mode() const { return ladder_.memory().mode; }

    std::optional<watch::LadderAction> look(MuseumTime now, const watch::Outcome& outcome) {
        if (policy_ == Policy::SystemdAlone) {
            return std::nullopt;
        }
        const watch::Observation seen = judge_.look(monotonic(now), mode(), outcome);
        const std::optional<watch::LadderAction> act =
            policy_ == Policy::Ladder ? ladder_.look(awake(now), seen, {true, true, true})
                                      : reboot_at(now, seen);
        if (act) {
            judge_.step_taken(monotonic(now));
        }
        return act;
    }

private:
    std::optional<watch::LadderAction> reboot_at(MuseumTime now, const watch::Observation& seen) {
        if (!seen.trouble || now - rebooted_ < between_reboots_s) {
            return std::nullopt;
        }
        rebooted_ = now;
        return watch::LadderAction{watch::Step::Reboot, seen.trouble};
    }

    Policy policy_;
    watch::Ladder ladder_{watch::LadderMemory{}, true};
    watch::Judge judge_{watch::Timeouts{}, monotonic(0)};
    MuseumTime rebooted_ = -between_reboots_s;
};

class Life {
public:
    Life(Policy policy, std::span<const FaultEvent> fault_events, std::uint64_t seed)
        : fault_events_(fault_events), keeper_(policy), load_(seed) {
        run_.policy = policy;
    }

    void pass(MuseumTime now) {
        for (; next_ < fault_events_.size() && fault_events_[next_].at <= now; ++next_) {
            kiosk_.fault_event(fault_events_[next_], now);
            latest_fault_ = fault_events_[next_].fault;
        }
        if (now % museum_day == opens_s || now % museum_day == second_round_s) {
            make_the_round(now);
        }
        std::optional<watch::Outcome> outcome = kiosk_.pass(now);
        if (outcome && was_booting_) {
            keeper_.boot(now);
            kiosk_.show(keeper_.mode());
        }
        was_booting_ = !outcome;
        note_health(now);
        if (outcome && load_.lets_look(now)) {
            look(now, *outcome);
        }
        account(now);
    }
    MuseumRun end() {
        for (std::size_t k = 0; k < reboots_.size(); ++k) {
            const auto within =
                std::upper_bound(reboots_.begin(), reboots_.end(), reboots_[k] + museum_day - 1);
            run_.max_reboots_in_day =
                std::max(run_.max_reboots_in_day, static_cast<std::size_t>(within - reboots_.begin()) - k);
        }
        return std::move(run_);
    }

private:
    /// The staff's round: they power-cycle a kiosk that does not look well.
    void make_the_round(MuseumTime now) {
        if (kiosk_.shown() != VisibleState::Whole && kiosk_.shown() != VisibleState::BuiltIn) {
            kiosk_.fault_event({now, FaultKind::PowerCut, now}, now);
        }
    }

    void note_health(MuseumTime now) {
        const VisibleState shown = kiosk_.shown();
        const bool is_well =
            !kiosk_.is_ill() && (shown == VisibleState::Whole || shown == VisibleState::BuiltIn);
        well_since_ = is_well ? well_since_.value_or(now) : std::optional<MuseumTime>{};
    }

    void look(MuseumTime now, watch::Outcome& outcome) {
        const MuseumTime hour_s = now % museum_day;
        if (outcome.exhibit) {
            outcome.exhibit->asleep = hour_s >= sleeps_s || hour_s < wakes_s;
            outcome.exhibit->age += load_.status_age();
        }
        const std::optional<watch::LadderAction> act = keeper_.look(now, outcome);
        if (!act) {
            return;
        }
        const bool is_well = well_since_ && now - *well_since_ >= well_for_s;
        run_.steps.push_back({now, *act, is_well && act->step != watch::Step::Return});
        if (act->step == watch::Step::Reboot) {
            reboots_.push_back(now);
        }
        kiosk_.take(act->step, keeper_.mode(), now);
    }

    void account(MuseumTime now) {
        const MuseumTime hour_s = now % museum_day;
        const bool is_asleep = hour_s >= sleeps_s || hour_s < wakes_s;
        const VisibleState shown = is_asleep ? VisibleState::Whole : kiosk_.shown();
        if (hour_s >= opens_s && hour_s < closes_s) {
            ++run_.open.at(static_cast<std::size_t>(shown));
        }
        if (shown != VisibleState::Dark) {
            if (dark_since_) {
                run_.dark_times.push_back(now - *dark_since_);
                dark_since_.reset();
            }
            return;
        }
        if (!dark_since_) {
            dark_since_ = now;
            dark_by_ = latest_fault_;
        }
        const MuseumTime dark_s = now - *dark_since_ + 1;
        if (dark_by_) {
            MuseumTime& longest = run_.longest.at(static_cast<std::size_t>(*dark_by_));
            longest = std::max(longest, dark_s);
        }
        if (dark_s > run_.longest_dark_s) {
            run_.longest_dark_s = dark_s;
            run_.longest_dark_at = *dark_since_;
        }
    }

    std::span<const FaultEvent> fault_events_;
    std::size_t next_ = 0;
    KioskModel kiosk_;
    Keeper keeper_;
    Load load_;
    MuseumRun run_;
    bool was_booting_ = true;
    std::optional<FaultKind> latest_fault_, dark_by_;
    std::optional<MuseumTime> dark_since_, well_since_;
    std::vector<MuseumTime> reboots_;
};

} // namespace

std::string_view name_of(Policy policy) {
    switch (policy) {
    case Policy::Ladder:
        return "ladder";
    case Policy::SystemdAlone:
        return "systemd alone";
    case Policy::RebootAtEveryTrouble:
        return "reboot at every fault";
    }
    return "";
}

MuseumRun simulate(Policy policy, std::span<const FaultEvent> fault_events, int days, std::uint64_t seed) {
    Life life(policy, fault_events, seed);
    for (MuseumTime now = 0; now < days * museum_day; ++now) {
        life.pass(now);
    }
    return life.end();
}

} // namespace frustumscreen::simulators
