/// The recovery ladder: which action follows which fault, and when.
///
/// Table    for each cause the actions that may remedy it, mildest first (`steps_for`). An action that helped
///          is tried first when the cause recurs. Each action is tried once per episode; ten good minutes end
///          the episode.
/// Pauses   between two actions: `settling` of the first one, and `pause_after` the number of actions taken.
///          The pause doubles with each action, up to four hours, and halves with each ten good minutes. If
///          the next pause would keep the screen dark for longer than `longest_dark_pause`, the safe picture
///          is shown first.
/// Reboots  at most one in ten minutes and six in 24 hours, and only if the reboot can be recorded before.
/// Given up a fault with a lit picture is given up after all its actions have failed: it is ignored until it
///          has been absent for ten minutes.
/// Safe     the safe picture stays until the pause is over; then the remaining actions follow, a reboot last.
///          After a reboot the exhibit's own set is tried. If no reboot is allowed, the safe picture stays.
/// Down     from the fallback set, plain drawing and the built-in artifact the ladder returns to normal
///          after ten good minutes; the next time after twenty, and so on, up to a day.
/// Time     `awake`: the kiosk's total time of operation, over all boots. It never jumps, whatever the wall
///          clock shows, and never runs faster than real time, so a day's limits hold for real days too.
/// Threads  values; one caller. Allocates nothing.
#pragma once

#include "app/watch/cause.h"
#include "app/watch/step.h"

#include <array>
#include <chrono>
#include <cstdint>
#include <optional>
#include <span>

namespace frustumscreen::watch {

/// Time of operation since the kiosk was first switched on.
using Awake = std::chrono::milliseconds;

inline constexpr std::size_t reboots_a_day = 6;

/// State that survives a reboot.
struct LadderMemory {
    Awake awake{0};
    Mode mode = Mode::Normal;
    std::uint8_t climb = 0;     ///< actions taken, less one for each ten good minutes
    std::uint8_t returns = 0;   ///< returns tried since the last ten good minutes in normal mode
    std::uint8_t tried = 0;     ///< actions of this episode, one bit each
    std::optional<Cause> cause; ///< cause that began this episode
    std::optional<Step> latest; ///< latest action of this episode
    Awake latest_at{0};         ///< time of the latest action, in this episode or earlier
    std::array<std::optional<Step>, cause_count> helped{};
    std::uint8_t given_up = 0; ///< causes, one bit each
    /// Times of the latest reboots, latest first.
    std::array<std::optional<Awake>, reboots_a_day> reboots{};
    [[nodiscard]] bool operator==(const LadderMemory&) const = default;
};

/// The current observation, as the judge sums it up (judge.h).
struct Observation {
    std::optional<Cause> trouble;
    bool lit =
        false; ///< the exhibit's own picture is alive; false without a fault: it is starting, or the safe
               ///< picture is shown
};
/// Capabilities: what is possible now.
struct Capabilities {
    bool last_good_set = false; ///< it exists, and is not the active set
    bool device = false;        ///< the tracker is plugged in
    bool reboot = false;        ///< a reboot could be recorded
};
/// An action to take now; the caller takes it, whether it succeeds or not, and calls `look` again a second
/// later.
struct LadderAction {
    Step step = Step::RestartExhibit;
    std::optional<Cause> cause; ///< none: ten good minutes
    [[nodiscard]] bool operator==(const LadderAction&) const = default;
};

class Ladder {
public:
    static constexpr Awake good_for = std::chrono::minutes(10);
    static constexpr Awake longest_pause = std::chrono::hours(4);
    static constexpr Awake longest_dark_pause = std::chrono::minutes(1);
    static constexpr Awake longest_return = std::chrono::hours(24);
    static constexpr Awake between_reboots = std::chrono::minutes(10);
    static constexpr Awake day = std::chrono::hours(24);
    static constexpr std::uint8_t highest_climb = 12; ///< higher values do not lengthen the pause
    static constexpr std::uint8_t max_returns = 8;    ///< as above

    /// `is_boot`: the kiosk was switched on; false: only this program was restarted.
    Ladder(const LadderMemory& memory, bool is_boot);

    /// Call it about once a second; `awake` never decreases.
    [[nodiscard]] std::optional<LadderAction> look(Awake awake, const Observation& seen,
                                                   const Capabilities& capabilities);
    [[nodiscard]] const LadderMemory& memory() const { return memory_; }
    [[nodiscard]] std::size_t reboots_within_day() const;

    [[nodiscard]] static std::span<const Step> steps_for(Cause cause);
    /// Time until an action shows its effect.
    [[nodiscard]] static Awake settling(Step step);
    /// Pause before the next action, once `climb` actions were taken.
    [[nodiscard]] static Awake pause_after(std::uint8_t climb);
    /// Time that a degraded mode must be good before it is left.
    [[nodiscard]] static Awake return_after(std::uint8_t returns);

private:
    [[nodiscard]] std::optional<LadderAction> climb(Cause cause, const Capabilities& capabilities);
    [[nodiscard]] std::optional<LadderAction> leave_safe_picture(const Capabilities& capabilities);
    [[nodiscard]] std::optional<LadderAction> go_down();
    [[nodiscard]] std::optional<Step> next_for(Cause cause, const Capabilities& capabilities) const;
    [[nodiscard]] bool is_possible(Step step, Cause cause, const Capabilities& capabilities) const;
    [[nodiscard]] bool may_reboot(const Capabilities& capabilities) const;
    [[nodiscard]] bool is_over(Awake pause) const;
    [[nodiscard]] bool is_given_up(Cause cause) const;
    void forget_given_up(const std::optional<Cause>& trouble);
    LadderAction take(Step step, std::optional<Cause> cause);
    void end_episode();

    LadderMemory memory_;
    std::optional<Awake> good_since_;
    Awake went_down_at_{0};                    ///< time of the latest step down the ladder
    std::array<Awake, cause_count> seen_at_{}; ///< last occurrence of each cause
};

} // namespace frustumscreen::watch
