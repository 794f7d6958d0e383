/// The recovery ladder: which step follows which trouble, and when.
///
/// Table    for each cause the steps that may mend it, gentlest first (`steps_for`). A step that helped is tried first the next
///          time for the same cause. A step is tried once; ten good minutes end the episode, and all may be tried again.
/// Pauses   between two steps lie at least `settling` of the first one and `pause_after` as many steps as were taken; that
///          doubles with each step, up to four hours, and halves with each ten good minutes. Of a pause in the dark that is
///          longer than `longest_dark_pause` nobody has anything: the safe picture comes at once, and the pause after it.
/// Reboots  at most one in ten minutes and six in 24 hours, and only if that can be written down before.
/// Given up a trouble that leaves the picture lit, once all its steps were in vain: it counts for nothing until it was away for
///          ten minutes.
/// Safe     words for the staff stay until the pause is over; then comes what was not tried yet, at last a reboot. After a reboot
///          the exhibit's own set is tried. Where no reboot is allowed, they stay.
/// Down     from the last good set, plain drawing and the built-in artifact the ladder leads back after ten good minutes; after twenty the next
///          time, and so on, up to a day.
/// Time     `awake`: how long the kiosk has been on in all, over all boots. It never jumps, whatever the clock on the wall says,
///          and never runs faster than time does: so a day's limits hold for real days, too.
/// Threads  values; one caller. Allocates nothing.
#pragma once

#include "app/watch/cause.h"
#include "app/watch/step.h"

#include <array>
#include <chrono>
#include <cstdint>
#include <optional>
#include <span>

namespace frustumscreen {

/// Since the kiosk was first switched on, without the times that it was off.
using Awake = std::chrono::milliseconds;

inline constexpr std::size_t reboots_a_day = 6;

/// What survives a reboot.
struct LadderMemory {
    Awake awake{0};
    Mode mode = Mode::Normal;
    std::uint8_t climb = 0; ///< steps taken, less one for each ten good minutes
    std::uint8_t returns =
        0; ///< how often a return was tried since the last ten good minutes of the normal mode
    std::uint8_t tried = 0;     ///< steps of this episode, a bit each
    std::optional<Cause> cause; ///< that began this episode
    std::optional<Step> latest; ///< step of this episode
    Awake latest_at{0};         ///< when it was taken, in this episode or before
    std::array<std::optional<Step>, cause_count> helped{};
    std::uint8_t given_up = 0; ///< causes, a bit each
    /// When the latest reboots were; the latest is the first.
    std::array<std::optional<Awake>, reboots_a_day> reboots{};
    [[nodiscard]] bool operator==(const LadderMemory&) const = default;
};

/// What is seen now, as a judge sums it up (judge.h).
struct Seen {
    std::optional<Cause> trouble;
    bool lit =
        false; ///< the exhibit's own picture lives; false without trouble: it starts, or the safe picture is shown
};
/// What can be done now.
struct Means {
    bool last_good_set = false; ///< there is one, and it is not the set on show
    bool device = false;        ///< the tracker is plugged in
    bool reboot = false;        ///< a reboot could be written down
};
/// A step to take now; the caller takes it, whether it succeeds or not, and asks again a second later.
struct Act {
    Step step = Step::RestartExhibit;
    std::optional<Cause> cause; ///< none: ten good minutes
    [[nodiscard]] bool operator==(const Act&) const = default;
};

class Ladder {
public:
    static constexpr Awake good_for = std::chrono::minutes(10);
    static constexpr Awake longest_pause = std::chrono::hours(4);
    static constexpr Awake longest_dark_pause = std::chrono::minutes(1);
    static constexpr Awake longest_return = std::chrono::hours(24);
    static constexpr Awake between_reboots = std::chrono::minutes(10);
    static constexpr Awake day = std::chrono::hours(24);
    static constexpr std::uint8_t highest_climb = 12; ///< more makes no pause longer
    static constexpr std::uint8_t most_returns = 8;   ///< as above

    /// The kiosk was switched on, or only this program was started again: `is_boot`.
    Ladder(const LadderMemory& memory, bool is_boot);

    /// About once a second; `awake` never goes back.
    [[nodiscard]] std::optional<Act> look(Awake awake, const Seen& seen, const Means& means);
    [[nodiscard]] const LadderMemory& memory() const { return memory_; }
    [[nodiscard]] std::size_t reboots_within_day() const;

    [[nodiscard]] static std::span<const Step> steps_for(Cause cause);
    /// How long a step takes to show what it does.
    [[nodiscard]] static Awake settling(Step step);
    /// Before the next step, once `climb` steps were taken.
    [[nodiscard]] static Awake pause_after(std::uint8_t climb);
    /// How long a degraded mode must be good before it is left again.
    [[nodiscard]] static Awake return_after(std::uint8_t returns);

private:
    [[nodiscard]] std::optional<Act> climb(Cause cause, const Means& means);
    [[nodiscard]] std::optional<Act> leave_safe_picture(const Means& means);
    [[nodiscard]] std::optional<Act> go_down();
    [[nodiscard]] std::optional<Step> next_for(Cause cause, const Means& means) const;
    [[nodiscard]] bool is_possible(Step step, Cause cause, const Means& means) const;
    [[nodiscard]] bool may_reboot(const Means& means) const;
    [[nodiscard]] bool is_over(Awake pause) const;
    [[nodiscard]] bool is_given_up(Cause cause) const;
    void forget_given_up(const std::optional<Cause>& trouble);
    Act take(Step step, std::optional<Cause> cause);
    void end_episode();

    LadderMemory memory_;
    std::optional<Awake> good_since_;
    Awake went_down_at_{0};                    ///< for the latest ten good minutes
    std::array<Awake, cause_count> seen_at_{}; ///< each cause, at the latest
};

} // namespace frustumscreen
