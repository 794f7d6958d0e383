// Each fault alone, and months of all of them: the shortest ladder, and never a step for nothing.
#include "tests/simulators/museum/museum_report.h"

#include <gtest/gtest.h>

namespace frustumscreen::simulators {
namespace {

constexpr MuseumTime noon = 12 * 3600;

/// The steps against one fault that comes at noon and that a person mends five hours later.
std::vector<watch::Step> steps_against(FaultKind fault, MuseumTime restored_after = 5 * 3600) {
    const std::vector<FaultEvent> fault_events{{noon, fault, noon + restored_after}};
    const MuseumRun run = simulate(Policy::Ladder, fault_events, 2, 1);
    std::vector<watch::Step> steps;
    for (const TakenStep& taken : run.steps) {
        EXPECT_FALSE(taken.is_false_alarm);
        steps.push_back(taken.act.step);
    }
    return steps;
}

using Steps = std::vector<watch::Step>;

TEST(Museum, TakesNoStepForFaultsThatSystemdRepairs) {
    for (const FaultKind fault :
         {FaultKind::Crash, FaultKind::Hang, FaultKind::KernelHang, FaultKind::PowerCut}) {
        EXPECT_EQ(steps_against(fault), Steps{}) << kind_of(fault).name;
    }
}

TEST(Museum, TakesTheShortestLadderForEachFault) {
    EXPECT_EQ(steps_against(FaultKind::Freeze), Steps{watch::Step::RestartExhibit});
    EXPECT_EQ(steps_against(FaultKind::TrackerHung), Steps{watch::Step::ResetDevice});
    EXPECT_EQ(steps_against(FaultKind::DeviceThread), Steps{watch::Step::ResetDevice});
    EXPECT_EQ(steps_against(FaultKind::BadSet, 1800),
              (Steps{watch::Step::ResetDevice, watch::Step::LastGoodSet, watch::Step::Return,
                     watch::Step::LastGoodSet, watch::Step::Return}));
    for (const FaultKind fault : {FaultKind::DriverCrash, FaultKind::GpuWedged}) {
        EXPECT_EQ(steps_against(fault, 1800),
                  (Steps{watch::Step::ResetDevice, watch::Step::LastGoodSet, watch::Step::DrawPlainly,
                         watch::Step::Return, watch::Step::DrawPlainly, watch::Step::Return}))
            << kind_of(fault).name;
    }
}

TEST(Museum, GivesUpOnADeadTracker) {
    EXPECT_EQ(steps_against(FaultKind::TrackerDead),
              (Steps{watch::Step::ResetDevice, watch::Step::RestartExhibit, watch::Step::Reboot}));
}

TEST(Museum, BrokenMachineShowsWordsAndLimitsReboots) {
    const std::vector<FaultEvent> fault_events{{noon, FaultKind::MachineBroken, noon + 3 * museum_day}};
    const MuseumRun run = simulate(Policy::Ladder, fault_events, 5, 1);
    EXPECT_LE(run.max_reboots_in_day, watch::reboots_a_day);
    EXPECT_GE(count_of(run, watch::Step::Reboot), 6U);
    EXPECT_GT(run.open.at(static_cast<std::size_t>(VisibleState::Words)),
              20 * run.open.at(static_cast<std::size_t>(VisibleState::Dark)));
    EXPECT_LT(run.longest_dark_s, 300);
}

TEST(Museum, LadderIsNoWorseThanTheOtherPolicies) {
    constexpr int days = 100;
    const std::vector<FaultEvent> fault_events = seeded_faults(7, days, 5.0);
    ASSERT_GT(fault_events.size(), 100U);
    const MuseumRun ladder = simulate(Policy::Ladder, fault_events, days, 7);
    const MuseumRun alone = simulate(Policy::SystemdAlone, fault_events, days, 7);
    const MuseumRun reboots = simulate(Policy::RebootAtEveryTrouble, fault_events, days, 7);
    EXPECT_EQ(false_alarms(ladder), 0U);
    EXPECT_LE(ladder.max_reboots_in_day, watch::reboots_a_day);
    const auto whole = static_cast<std::size_t>(VisibleState::Whole);
    const auto dark = static_cast<std::size_t>(VisibleState::Dark);
    EXPECT_GE(ladder.open.at(whole), reboots.open.at(whole));
    EXPECT_GE(ladder.open.at(whole), alone.open.at(whole));
    EXPECT_LT(ladder.open.at(dark), alone.open.at(dark));
    EXPECT_LT(ladder.longest_dark_s, alone.longest_dark_s);
}

} // namespace
} // namespace frustumscreen::simulators
