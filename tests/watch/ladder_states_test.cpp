// Every state x every event: what must never happen, and what must happen.
#include "app/watch/ladder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <functional>
#include <vector>

namespace frustumscreen::watch {
namespace {

using std::chrono::hours;
using std::chrono::minutes;
using std::chrono::seconds;

constexpr Awake now = hours(1000);

struct Event {
    Observation seen;
    Capabilities capabilities;
};

std::vector<Event> all_events() {
    std::vector<Event> events;
    for (unsigned capabilities = 0; capabilities < 8; ++capabilities) {
        const Capabilities possible{(capabilities & 1U) != 0, (capabilities & 2U) != 0,
                                    (capabilities & 4U) != 0};
        events.push_back({{std::nullopt, true}, possible});
        events.push_back({{std::nullopt, false}, possible});
        for (std::size_t k = 0; k < cause_count; ++k) {
            events.push_back({{static_cast<Cause>(k), false}, possible});
            events.push_back({{static_cast<Cause>(k), true}, possible});
        }
    }
    return events;
}

/// Adds `count` reboots, the latest one `ago`.
void rebooted(LadderMemory& memory, std::size_t count, Awake ago) {
    for (std::size_t k = 0; k < count; ++k) {
        memory.reboots.at(k) = now - ago - k * minutes(30);
    }
}

void for_all_states(const std::function<void(const LadderMemory&)>& visit) {
    const std::array<Awake, 4> ages{Awake(0), seconds(10), seconds(1290), hours(6)};
    for (unsigned mode = 0; mode < mode_count; ++mode) {
        for (std::uint8_t climb = 0; climb <= Ladder::highest_climb; ++climb) {
            for (unsigned tried = 0; tried < 128; ++tried) {
                for (const unsigned given_up : {0U, 48U}) {
                    for (const Awake age : ages) {
                        for (unsigned helped = 0; helped < step_count; ++helped) { // `Return` never helps
                            for (unsigned reboots = 0; reboots < 4; ++reboots) {
                                LadderMemory memory;
                                memory.awake = now;
                                memory.mode = static_cast<Mode>(mode);
                                memory.climb = climb;
                                memory.tried = static_cast<std::uint8_t>(tried);
                                memory.given_up = static_cast<std::uint8_t>(given_up);
                                memory.cause = tried != 0 ? std::optional(Cause::NoPicture) : std::nullopt;
                                memory.latest = Step::RestartExhibit;
                                memory.latest_at = now - age;
                                if (helped + 1 < step_count) {
                                    memory.helped.fill(static_cast<Step>(helped));
                                }
                                rebooted(memory, std::array{0U, 1U, 6U, 5U}.at(reboots),
                                         reboots == 1 ? Awake(minutes(9)) : Awake(minutes(10)));
                                visit(memory);
                            }
                        }
                    }
                }
            }
        }
    }
}

bool was_tried(const LadderMemory& memory, Step step) {
    return (memory.tried >> static_cast<unsigned>(step) & 1U) != 0;
}
bool is_given_up(const LadderMemory& memory, Cause cause) {
    return (memory.given_up >> static_cast<unsigned>(cause) & 1U) != 0;
}

/// The rules, each written independently of the ladder's code. Returns the name of the broken rule, or null.
const char* broken_rule(const LadderMemory& before, const Event& event,
                        const std::optional<LadderAction>& act, const LadderMemory& after) {
    const Awake waited = now - before.latest_at;
    const Awake due = Ladder::settling(*before.latest) + Ladder::pause_after(before.climb);
    const bool is_troubled = event.seen.trouble && !is_given_up(before, *event.seen.trouble);
    const bool dark_and_due = is_troubled && is_dark(*event.seen.trouble) &&
                              waited >= std::min<Awake>(due, Ladder::settling(*before.latest) + minutes(1));
    if (!act) {
        return dark_and_due && before.mode != Mode::Safe ? "a dark kiosk is left dark" : nullptr;
    }
    if (!is_troubled && before.mode != Mode::Safe) {
        return "a step without trouble"; // ten good minutes cannot be seen in one check
    }
    if (!act->cause) {
        return "a step without a cause";
    }
    const bool is_long = Ladder::pause_after(before.climb) > minutes(1);
    const bool rests =
        act->step == Step::SafePicture && is_long && waited >= Ladder::settling(*before.latest);
    if (waited < due && !rests) {
        return "a step before the pause is over";
    }
    if (act->step == Step::Reboot) {
        const bool is_late = !before.reboots[0] || now - *before.reboots[0] >= minutes(10);
        if (!event.capabilities.reboot || before.reboots[5] || !is_late) {
            return "a reboot that is not allowed";
        }
    } else if (was_tried(before, act->step) && act->step != Step::SafePicture) {
        return "a step is tried twice";
    }
    if ((act->step == Step::ResetDevice && !event.capabilities.device) ||
        (act->step == Step::LastGoodSet && !event.capabilities.last_good_set)) {
        return "a step that cannot be taken";
    }
    if (before.mode == Mode::Safe && (act->step == Step::RestartExhibit || act->step == Step::SafePicture)) {
        return "the safe picture is left by what left the table dark";
    }
    const bool is_longest = before.climb == Ladder::highest_climb;
    if (after.climb != before.climb + (is_longest ? 0 : 1) ||
        (!is_longest && Ladder::pause_after(after.climb) <= Ladder::pause_after(before.climb) &&
         Ladder::pause_after(before.climb) < Ladder::longest_pause)) {
        return "the pause does not grow";
    }
    const bool goes_down =
        before.mode != Mode::Safe && static_cast<unsigned>(after.mode) < static_cast<unsigned>(before.mode);
    return goes_down && act->step != Step::Reboot ? "a step leads to a better mode without ten good minutes"
                                                  : nullptr;
}

TEST(LadderStates, NoStateAndEventBreaksARule) {
    const std::vector<Event> events = all_events();
    std::size_t count = 0;
    std::size_t acts = 0;
    for_all_states([&](const LadderMemory& before) {
        for (const Event& event : events) {
            Ladder ladder(before, false);
            const std::optional<LadderAction> act = ladder.look(now, event.seen, event.capabilities);
            const char* const broken = broken_rule(before, event, act, ladder.memory());
            if (broken != nullptr && ++count < 10) {
                ADD_FAILURE() << broken << ": mode " << word_of(before.mode) << " climb " << int{before.climb}
                              << " tried " << int{before.tried} << " trouble "
                              << (event.seen.trouble ? word_of(*event.seen.trouble) : "none") << " step "
                              << (act ? word_of(act->step) : "none");
            }
            acts += act ? 1 : 0;
        }
    });
    EXPECT_EQ(count, 0U);
    EXPECT_GT(acts, 1'000'000U); // otherwise no state mattered
}

TEST(LadderStates, StepTablesAreValid) {
    for (std::size_t k = 0; k < cause_count; ++k) {
        const auto cause = static_cast<Cause>(k);
        const std::span<const Step> steps = Ladder::steps_for(cause);
        ASSERT_FALSE(steps.empty());
        EXPECT_EQ(steps.back(), Step::Reboot) << word_of(cause);
        EXPECT_EQ(std::count(steps.begin(), steps.end(), Step::Return), 0);
        for (const Step step : steps) {
            EXPECT_EQ(std::count(steps.begin(), steps.end(), step), 1);
        }
        const bool has_safe_picture = std::count(steps.begin(), steps.end(), Step::SafePicture) == 1;
        EXPECT_EQ(has_safe_picture, is_dark(cause) && cause != Cause::SafePictureFails) << word_of(cause);
    }
}

TEST(LadderStates, RoundTripOfEveryWord) {
    for (std::size_t k = 0; k < cause_count; ++k) {
        EXPECT_EQ(cause_named(word_of(static_cast<Cause>(k))), static_cast<Cause>(k));
        EXPECT_FALSE(sentence_of(static_cast<Cause>(k)).empty());
    }
    for (std::size_t k = 0; k < step_count; ++k) {
        EXPECT_EQ(step_named(word_of(static_cast<Step>(k))), static_cast<Step>(k));
        EXPECT_FALSE(sentence_of(static_cast<Step>(k)).empty());
    }
    for (std::size_t k = 0; k < mode_count; ++k) {
        EXPECT_EQ(mode_named(word_of(static_cast<Mode>(k))), static_cast<Mode>(k));
    }
    EXPECT_FALSE(cause_named("well"));
    EXPECT_FALSE(mode_named(""));
}

} // namespace
} // namespace frustumscreen::watch
