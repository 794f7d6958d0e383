// Plain scenarios of the ladder: one fault, its steps and their times.
#include "app/watch/ladder.h"

#include <gtest/gtest.h>

#include <vector>

namespace frustumscreen::watch {
namespace {

using std::chrono::hours;
using std::chrono::minutes;
using std::chrono::seconds;

struct Taken {
    Step step;
    std::int64_t after_s; ///< since the fault began
};
void PrintTo(const Taken& taken, std::ostream* out) {
    *out << word_of(taken.step) << " after " << taken.after_s << " s";
}
bool operator==(const Taken& a, const Taken& b) {
    return a.step == b.step && a.after_s == b.after_s;
}

/// A kiosk with everything that a step needs, checked every second.
struct Kiosk {
    LadderMemory memory;
    Ladder ladder{memory, true};
    Awake now{0};
    Capabilities capabilities{true, true, true};

    std::vector<Taken> see(const Observation& seen, Awake length) {
        std::vector<Taken> taken;
        const Awake begin = now;
        for (const Awake end = now + length; now < end; now += seconds(1)) {
            if (const std::optional<LadderAction> act = ladder.look(now, seen, capabilities)) {
                EXPECT_EQ(act->cause.has_value(), act->step != Step::Return);
                taken.push_back({act->step, std::chrono::duration_cast<seconds>(now - begin).count()});
            }
        }
        return taken;
    }
    std::vector<Taken> good(Awake length) { return see({std::nullopt, true}, length); }
    std::vector<Taken> bad(Cause cause, Awake length) { return see({cause, !is_dark(cause)}, length); }
    /// The effect of each step: the exhibit is dark for a moment and starts.
    void starts(Awake length = seconds(3)) { EXPECT_TRUE(see({std::nullopt, false}, length).empty()); }
};

using Steps = std::vector<Taken>;

TEST(Ladder, NeverActsOnAHealthyExhibit) {
    Kiosk kiosk;
    EXPECT_TRUE(kiosk.good(hours(48)).empty());
    EXPECT_EQ(kiosk.ladder.memory().climb, 0);
}

TEST(Ladder, ClimbsWithGrowingPausesToTheSafePictureAndReboots) {
    Kiosk kiosk;
    EXPECT_EQ(kiosk.bad(Cause::NoPicture, minutes(4)), (Steps{{Step::RestartExhibit, 0},
                                                              {Step::LastGoodSet, 20},
                                                              {Step::DrawPlainly, 50},
                                                              {Step::BuiltIn, 100},
                                                              {Step::SafePicture, 110}}));
    // The safe picture is not a fault; a reboot ends it.
    EXPECT_EQ(kiosk.see({}, minutes(3)), (Steps{{Step::Reboot, 40}})); // 10 + 160 - 130 seconds
    EXPECT_EQ(kiosk.ladder.memory().mode, Mode::Normal);
    EXPECT_EQ(kiosk.ladder.reboots_within_day(), 1U);
}

TEST(Ladder, RebootsAtMostSixTimesADay) {
    Kiosk kiosk;
    std::vector<Awake> reboots;
    for (const Awake end = hours(72); kiosk.now < end; kiosk.now += seconds(1)) {
        const bool is_safe = kiosk.ladder.memory().mode == Mode::Safe;
        const Observation seen = is_safe ? Observation{} : Observation{Cause::NoPicture, false};
        const std::optional<LadderAction> act = kiosk.ladder.look(kiosk.now, seen, kiosk.capabilities);
        if (act && act->step == Step::Reboot) {
            reboots.push_back(kiosk.now);
            kiosk.ladder = Ladder(kiosk.ladder.memory(), true);
        }
    }
    ASSERT_GT(reboots.size(), 6U);
    for (std::size_t k = 1; k < reboots.size(); ++k) {
        EXPECT_GE(reboots[k] - reboots[k - 1], minutes(10));
    }
    for (std::size_t k = 6; k < reboots.size(); ++k) {
        EXPECT_GE(reboots[k] - reboots[k - 6], hours(24));
    }
    EXPECT_EQ(kiosk.ladder.memory().mode, Mode::Safe);
}

TEST(Ladder, TriesFirstTheStepThatHelpedBefore) {
    Kiosk kiosk;
    EXPECT_EQ(kiosk.bad(Cause::NoPicture, seconds(60)),
              (Steps{{Step::RestartExhibit, 0}, {Step::LastGoodSet, 20}, {Step::DrawPlainly, 50}}));
    kiosk.starts();
    // Ten good minutes, then return to the exhibit's own set.
    EXPECT_EQ(kiosk.good(minutes(11)), (Steps{{Step::Return, 600}}));
    kiosk.starts();
    EXPECT_TRUE(kiosk.good(minutes(30)).empty());
    EXPECT_EQ(kiosk.bad(Cause::NoPicture, seconds(5)), (Steps{{Step::DrawPlainly, 0}}));
}

TEST(Ladder, DoublesTheWaitWithEachReturn) {
    Kiosk kiosk;
    std::vector<std::int64_t> good_for_min;
    for (int round = 0; round < 5; ++round) {
        while (kiosk.ladder.memory().mode == Mode::Normal) {
            (void)kiosk.bad(Cause::KeepsEnding, seconds(1));
        }
        kiosk.starts();
        const std::vector<Taken> taken = kiosk.good(hours(20));
        ASSERT_FALSE(taken.empty());
        EXPECT_EQ(taken.front().step, Step::Return);
        good_for_min.push_back(taken.front().after_s / 60);
        // It fails again before ten good minutes have passed.
        kiosk.ladder = Ladder(kiosk.ladder.memory(), false);
        LadderMemory memory = kiosk.ladder.memory();
        memory.returns = static_cast<std::uint8_t>(round + 1);
        kiosk.ladder = Ladder(memory, false);
    }
    EXPECT_EQ(good_for_min, (std::vector<std::int64_t>{10, 20, 40, 80, 160}));
}

TEST(Ladder, GivesUpOnADeviceAfterAllSteps) {
    Kiosk kiosk;
    EXPECT_EQ(kiosk.bad(Cause::DeviceSilent, hours(30)),
              (Steps{{Step::ResetDevice, 0}, {Step::RestartExhibit, 20}, {Step::Reboot, 50}}));
    EXPECT_EQ(kiosk.ladder.memory().given_up, 1U << static_cast<unsigned>(Cause::DeviceSilent));
    // After ten minutes without the fault, it counts again.
    EXPECT_TRUE(kiosk.good(minutes(20)).empty());
    EXPECT_EQ(kiosk.ladder.memory().given_up, 0);
    EXPECT_EQ(kiosk.bad(Cause::DeviceSilent, seconds(5)), (Steps{{Step::ResetDevice, 0}}));
}

TEST(Ladder, ReturnsToNormalDespiteADeviceThatWasGivenUp) {
    Kiosk kiosk;
    (void)kiosk.bad(Cause::DeviceSilent, hours(1));
    (void)kiosk.bad(Cause::NothingToShow, seconds(5));
    ASSERT_NE(kiosk.ladder.memory().mode, Mode::Normal);
    EXPECT_EQ(kiosk.bad(Cause::DeviceSilent, minutes(15)), (Steps{{Step::Return, 600}}));
}

TEST(Ladder, SkipsUnavailableSteps) {
    Kiosk kiosk;
    kiosk.capabilities = {};
    EXPECT_EQ(kiosk.bad(Cause::NoPicture, minutes(2)), (Steps{{Step::RestartExhibit, 0},
                                                              {Step::DrawPlainly, 20},
                                                              {Step::BuiltIn, 50},
                                                              {Step::SafePicture, 100}}));
    EXPECT_TRUE(kiosk.see({}, hours(10)).empty()) << "a reboot that cannot be written down";
}

TEST(Ladder, RestartOfThisProgramKeepsTheMode) {
    Kiosk kiosk;
    (void)kiosk.bad(Cause::NoPicture, minutes(2));
    ASSERT_EQ(kiosk.ladder.memory().mode, Mode::Safe);
    kiosk.ladder = Ladder(kiosk.ladder.memory(), false);
    EXPECT_EQ(kiosk.ladder.memory().mode, Mode::Safe);
    kiosk.ladder = Ladder(kiosk.ladder.memory(), true); // staff power-cycled it
    EXPECT_EQ(kiosk.ladder.memory().mode, Mode::Normal);
}

TEST(Ladder, SafePictureThatFailsLeadsToAReboot) {
    Kiosk kiosk;
    (void)kiosk.bad(Cause::NoPicture, minutes(2));
    const std::vector<Taken> taken = kiosk.see({Cause::SafePictureFails, false}, seconds(200));
    ASSERT_EQ(taken.size(), 1U);
    EXPECT_EQ(taken.front().step, Step::Reboot);
}

} // namespace
} // namespace frustumscreen::watch
