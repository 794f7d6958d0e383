// Each ailment alone, and months of all of them: the shortest ladder, and never a step for nothing.
#include "tests/simulators/museum/museum_report.h"

#include <gtest/gtest.h>

namespace frustumscreen {
namespace {

constexpr MuseumTime noon = 12 * 3600;

/// The steps against one ailment that comes at noon and that a person mends five hours later.
std::vector<Step> steps_against(Ailment ailment, MuseumTime mended_after = 5 * 3600) {
    const std::vector<Attack> attacks{{noon, ailment, noon + mended_after}};
    const MuseumRun run = simulate(Policy::Ladder, attacks, 2, 1);
    std::vector<Step> steps;
    for (const TakenStep& taken : run.steps) {
        EXPECT_FALSE(taken.is_false_alarm);
        steps.push_back(taken.act.step);
    }
    return steps;
}

using Steps = std::vector<Step>;

TEST(Museum, WhatSystemdMendsNeedsNoStep) {
    for (const Ailment ailment : {Ailment::Crash, Ailment::Hang, Ailment::KernelHang, Ailment::PowerCut}) {
        EXPECT_EQ(steps_against(ailment), Steps{}) << kind_of(ailment).name;
    }
}

TEST(Museum, EachAilmentMeetsTheShortestLadder) {
    EXPECT_EQ(steps_against(Ailment::Freeze), Steps{Step::RestartExhibit});
    EXPECT_EQ(steps_against(Ailment::TrackerHung), Steps{Step::ResetDevice});
    EXPECT_EQ(steps_against(Ailment::DeviceThread), Steps{Step::ResetDevice});
    EXPECT_EQ(steps_against(Ailment::BadSet, 1800),
              (Steps{Step::ResetDevice, Step::LastGoodSet, Step::Return, Step::LastGoodSet, Step::Return}));
    for (const Ailment ailment : {Ailment::DriverCrash, Ailment::GpuWedged}) {
        EXPECT_EQ(steps_against(ailment, 1800),
                  (Steps{Step::ResetDevice, Step::LastGoodSet, Step::DrawPlainly, Step::Return,
                         Step::DrawPlainly, Step::Return}))
            << kind_of(ailment).name;
    }
}

TEST(Museum, ADeadTrackerIsGivenUp) {
    EXPECT_EQ(steps_against(Ailment::TrackerDead),
              (Steps{Step::ResetDevice, Step::RestartExhibit, Step::Reboot}));
}

TEST(Museum, ABrokenMachineShowsWordsAndRestsBetweenReboots) {
    const std::vector<Attack> attacks{{noon, Ailment::MachineBroken, noon + 3 * museum_day}};
    const MuseumRun run = simulate(Policy::Ladder, attacks, 5, 1);
    EXPECT_LE(run.most_reboots_in_day, reboots_a_day);
    EXPECT_GE(count_of(run, Step::Reboot), 6U);
    EXPECT_GT(run.open.at(static_cast<std::size_t>(VisibleState::Words)),
              20 * run.open.at(static_cast<std::size_t>(VisibleState::Dark)));
    EXPECT_LT(run.longest_dark_s, 300);
}

TEST(Museum, MonthsOfEverything) {
    constexpr int days = 100;
    const std::vector<Attack> attacks = seeded_attacks(7, days, 5.0);
    ASSERT_GT(attacks.size(), 100U);
    const MuseumRun ladder = simulate(Policy::Ladder, attacks, days, 7);
    const MuseumRun alone = simulate(Policy::SystemdAlone, attacks, days, 7);
    const MuseumRun reboots = simulate(Policy::RebootAtEveryTrouble, attacks, days, 7);
    EXPECT_EQ(false_alarms(ladder), 0U);
    EXPECT_LE(ladder.most_reboots_in_day, reboots_a_day);
    const auto whole = static_cast<std::size_t>(VisibleState::Whole);
    const auto dark = static_cast<std::size_t>(VisibleState::Dark);
    EXPECT_GE(ladder.open.at(whole), reboots.open.at(whole));
    EXPECT_GE(ladder.open.at(whole), alone.open.at(whole));
    EXPECT_LT(ladder.open.at(dark), alone.open.at(dark));
    EXPECT_LT(ladder.longest_dark_s, alone.longest_dark_s);
}

} // namespace
} // namespace frustumscreen
