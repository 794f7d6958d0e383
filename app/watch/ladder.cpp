#include "app/watch/ladder.h"

#include <algorithm>
#include <cassert>

namespace frustumscreen::watch {

namespace {

using std::chrono::seconds;

// Reasons for the order: systemd restarts an exhibit that ends, so a restart is no remedy for `keeps_ending`.
// A hung device makes the exhibit end repeatedly, and switching its port takes a second. A restart does not
// repair a set that cannot be shown. A graphics driver that crashes at each start does so with any set; plain
// drawing keeps the museum's own set on the table.
constexpr std::array safe_picture_fails{Step::Reboot};
constexpr std::array keeps_ending{Step::ResetDevice, Step::LastGoodSet, Step::DrawPlainly,
                                  Step::BuiltIn,     Step::SafePicture, Step::Reboot};
constexpr std::array no_picture{Step::RestartExhibit, Step::LastGoodSet, Step::DrawPlainly,
                                Step::BuiltIn,        Step::SafePicture, Step::Reboot};
constexpr std::array nothing_to_show{Step::LastGoodSet, Step::RestartExhibit, Step::BuiltIn,
                                     Step::SafePicture, Step::Reboot};
constexpr std::array memory_short{Step::RestartExhibit, Step::BuiltIn, Step::Reboot};
constexpr std::array device_silent{Step::ResetDevice, Step::RestartExhibit, Step::Reboot};

constexpr std::array<std::span<const Step>, cause_count> table{
    safe_picture_fails, keeps_ending, no_picture, nothing_to_show, memory_short, device_silent};

constexpr std::array<Awake, step_count> settling_times{seconds(10), seconds(10), seconds(10), seconds(10),
                                                       seconds(10), seconds(10), seconds(60), seconds(10)};

template <typename Enum> constexpr std::uint8_t bit(Enum value) {
    return static_cast<std::uint8_t>(1U << static_cast<unsigned>(value));
}
template <typename Enum> constexpr bool holds(std::uint8_t bits, Enum value) {
    return (bits & bit(value)) != 0;
}

/// Doubles `first` `times` times, up to `longest`.
Awake doubled(Awake first, unsigned times, Awake longest) {
    Awake result = first;
    for (unsigned k = 0; k < times && result < longest; ++k) {
        result *= 2;
    }
    return std::min(result, longest);
}

} // namespace

std::span<const Step> Ladder::steps_for(Cause cause) {
    return table.at(static_cast<std::size_t>(cause));
}

Awake Ladder::settling(Step step) {
    return settling_times.at(static_cast<std::size_t>(step));
}

Awake Ladder::pause_after(std::uint8_t climb) {
    return climb == 0 ? Awake{0} : doubled(seconds(10), climb - 1U, longest_pause);
}

Awake Ladder::return_after(std::uint8_t returns) {
    return doubled(good_for, returns, longest_return);
}

Ladder::Ladder(const LadderMemory& memory, bool is_boot) : memory_(memory) {
    if (is_boot && memory_.mode == Mode::Safe) {
        memory_.mode = Mode::Normal; // after switching on, the staff expect the exhibit
    }
    seen_at_.fill(memory_.awake);
}

std::size_t Ladder::reboots_within_day() const {
    return static_cast<std::size_t>(
        std::count_if(memory_.reboots.begin(), memory_.reboots.end(),
                      [&](const std::optional<Awake>& at) { return at && memory_.awake - *at < day; }));
}

std::optional<LadderAction> Ladder::look(Awake awake, const Observation& seen,
                                         const Capabilities& capabilities) {
    assert(awake >= memory_.awake);
    memory_.awake = awake;
    forget_given_up(seen.trouble);
    const bool troubled = seen.trouble && !is_given_up(*seen.trouble);
    if (troubled || !seen.lit) {
        good_since_.reset();
    } else if (!good_since_) {
        good_since_ = went_down_at_ = awake;
    }
    if (memory_.latest && awake - memory_.latest_at < settling(*memory_.latest)) {
        return std::nullopt;
    }
    if (troubled) {
        return climb(*seen.trouble, capabilities);
    }
    if (memory_.mode == Mode::Safe) {
        return leave_safe_picture(capabilities);
    }
    return good_since_ ? go_down() : std::nullopt;
}

bool Ladder::is_given_up(Cause cause) const {
    return holds(memory_.given_up, cause);
}

void Ladder::forget_given_up(const std::optional<Cause>& trouble) {
    for (std::size_t k = 0; k < cause_count; ++k) {
        if (trouble == static_cast<Cause>(k)) {
            seen_at_[k] = memory_.awake;
        } else if (memory_.awake - seen_at_[k] >= good_for) {
            memory_.given_up = static_cast<std::uint8_t>(memory_.given_up & ~(1U << k));
        }
    }
}

bool Ladder::is_over(Awake pause) const {
    return !memory_.latest || memory_.awake - memory_.latest_at >= settling(*memory_.latest) + pause;
}

bool Ladder::may_reboot(const Capabilities& capabilities) const {
    const std::optional<Awake>& latest = memory_.reboots.front();
    return capabilities.reboot && reboots_within_day() < reboots_a_day &&
           (!latest || memory_.awake - *latest >= between_reboots);
}

bool Ladder::is_possible(Step step, Cause cause, const Capabilities& capabilities) const {
    switch (step) {
    case Step::RestartExhibit:
        return memory_.mode != Mode::Safe;
    case Step::ResetDevice:
        return capabilities.device;
    case Step::LastGoodSet:
        return capabilities.last_good_set && memory_.mode == Mode::Normal;
    case Step::DrawPlainly:
        return memory_.mode == Mode::Normal || memory_.mode == Mode::LastGoodSet;
    case Step::BuiltIn:
        return memory_.mode != Mode::BuiltIn && memory_.mode != Mode::Safe;
    case Step::SafePicture:
        return memory_.mode != Mode::Safe && is_dark(cause);
    case Step::Reboot:
        return may_reboot(capabilities);
    case Step::Return:
        break;
    }
    return false;
}

std::optional<Step> Ladder::next_for(Cause cause, const Capabilities& capabilities) const {
    const auto is_next = [&](Step step) {
        return !holds(memory_.tried, step) && is_possible(step, cause, capabilities);
    };
    const std::span<const Step> steps = steps_for(cause);
    const std::optional<Step>& helped = memory_.helped.at(static_cast<std::size_t>(cause));
    if (helped && is_next(*helped)) {
        return helped;
    }
    const auto next = std::find_if(steps.begin(), steps.end(), is_next);
    return next != steps.end() ? std::optional(*next) : std::nullopt;
}

std::optional<LadderAction> Ladder::climb(Cause cause, const Capabilities& capabilities) {
    const bool would_rest_in_the_dark = is_dark(cause) && memory_.mode != Mode::Safe;
    if (!is_over(pause_after(memory_.climb))) {
        const bool is_long = pause_after(memory_.climb) > longest_dark_pause;
        return would_rest_in_the_dark && is_long ? std::optional(take(Step::SafePicture, cause))
                                                 : std::nullopt;
    }
    if (const std::optional<Step> next = next_for(cause, capabilities)) {
        return take(*next, cause);
    }
    if (would_rest_in_the_dark) {
        return take(Step::SafePicture, cause); // again: it was left without success
    }
    if (is_dark(cause)) {
        return may_reboot(capabilities) ? std::optional(take(Step::Reboot, cause)) : std::nullopt;
    }
    memory_.given_up = static_cast<std::uint8_t>(memory_.given_up | bit(cause));
    end_episode();
    return std::nullopt;
}

std::optional<LadderAction> Ladder::leave_safe_picture(const Capabilities& capabilities) {
    if (!is_over(pause_after(memory_.climb))) {
        return std::nullopt;
    }
    const Cause cause = memory_.cause.value_or(Cause::NoPicture);
    const std::optional<Step> next =
        next_for(cause, {capabilities.last_good_set, false, capabilities.reboot});
    if (next) {
        return take(*next, cause);
    }
    return may_reboot(capabilities) ? std::optional(take(Step::Reboot, cause)) : std::nullopt;
}

std::optional<LadderAction> Ladder::go_down() {
    if (memory_.awake - went_down_at_ >= good_for) {
        went_down_at_ += good_for;
        memory_.climb = static_cast<std::uint8_t>(std::max(memory_.climb - 1, 0));
        memory_.returns = memory_.mode == Mode::Normal ? std::uint8_t{0} : memory_.returns;
        if (memory_.cause && memory_.latest) {
            memory_.helped.at(static_cast<std::size_t>(*memory_.cause)) = memory_.latest;
        }
        end_episode();
    }
    const bool is_degraded = memory_.mode != Mode::Normal;
    if (!is_degraded || memory_.awake - *good_since_ < return_after(memory_.returns)) {
        return std::nullopt;
    }
    return take(Step::Return, std::nullopt);
}

void Ladder::end_episode() {
    memory_.tried = 0;
    memory_.cause.reset();
}

LadderAction Ladder::take(Step step, std::optional<Cause> cause) {
    memory_.tried = static_cast<std::uint8_t>(memory_.tried | (cause ? bit(step) : 0U));
    memory_.climb = std::min<std::uint8_t>(static_cast<std::uint8_t>(memory_.climb + 1), highest_climb);
    memory_.cause = memory_.cause ? memory_.cause : cause;
    memory_.latest = step;
    memory_.latest_at = memory_.awake;
    good_since_.reset();
    switch (step) {
    case Step::LastGoodSet:
        memory_.mode = Mode::LastGoodSet;
        break;
    case Step::DrawPlainly:
        memory_.mode = Mode::Plain;
        break;
    case Step::BuiltIn:
        memory_.mode = Mode::BuiltIn;
        break;
    case Step::SafePicture:
        memory_.mode = Mode::Safe;
        break;
    case Step::Return:
        memory_.mode = Mode::Normal;
        memory_.returns = static_cast<std::uint8_t>(std::min<int>(memory_.returns + 1, max_returns));
        break;
    case Step::Reboot:
        memory_.mode = Mode::Normal;
        std::copy_backward(memory_.reboots.begin(), memory_.reboots.end() - 1, memory_.reboots.end());
        memory_.reboots.front() = memory_.awake;
        break;
    case Step::RestartExhibit:
    case Step::ResetDevice:
        break;
    }
    return {step, cause};
}

} // namespace frustumscreen::watch
