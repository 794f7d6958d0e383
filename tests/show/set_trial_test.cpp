// The verdict on an installed set, over time and over starts.

#include "app/show/set_trial.h"

#include <gtest/gtest.h>

namespace frustumscreen::show {
namespace {

using std::chrono::hours;
using std::chrono::milliseconds;
using std::chrono::seconds;

const MonotonicTime start{seconds(1000)};

library::InstalledSet set_of(std::uint64_t number) {
    library::InstalledSet set;
    set.number = number;
    return set;
}
library::SetChoice on_trial() {
    return {set_of(8), set_of(7)};
}
/// Shows the set in steps of half a second.
void show(SetTrial& trial, MonotonicTime from, Nanoseconds length, std::uint64_t number = 8) {
    for (MonotonicTime now = from; now <= from + length; now += milliseconds(500)) {
        trial.shown(now, number, "");
    }
}

TEST(SetTrial, IsGoodAfterHalfAMinuteWithoutAFault) {
    SetTrial trial(on_trial(), std::nullopt);
    EXPECT_EQ(trial.verdict(), (library::SetVerdict{8, library::TrialState::Trying, 1, ""}));
    EXPECT_TRUE(trial.on_trial());
    show(trial, start, milliseconds(29'500));
    EXPECT_EQ(trial.verdict().state, library::TrialState::Trying);
    trial.shown(start + seconds(30), 8, "");
    EXPECT_EQ(trial.verdict().state, library::TrialState::Good);
    EXPECT_FALSE(trial.on_trial());
    EXPECT_EQ(trial.target().number, 8U);
    trial.shown(start + seconds(31), 8, "one pack went bad later"); // a later fault is no reason to go back
    EXPECT_EQ(trial.verdict().state, library::TrialState::Good);
}

TEST(SetTrial, AGapOrAClockJumpRestartsTheHalfMinute) {
    SetTrial silent(on_trial(), std::nullopt);
    show(silent, start, seconds(20));
    show(silent, start + milliseconds(22'100), seconds(29));
    EXPECT_EQ(silent.verdict().state, library::TrialState::Trying);
    show(silent, start + milliseconds(51'100), seconds(1));
    EXPECT_EQ(silent.verdict().state, library::TrialState::Good);

    SetTrial jumping(on_trial(), std::nullopt);
    show(jumping, start + hours(1000), seconds(20));
    show(jumping, start, seconds(29)); // a monotonic clock never does that; it has no effect
    EXPECT_EQ(jumping.verdict().state, library::TrialState::Trying);
    jumping.shown(start + hours(2000), 8, ""); // a jump has no effect either
    EXPECT_EQ(jumping.verdict().state, library::TrialState::Trying);
}

TEST(SetTrial, TheTimeOfAnotherSetDoesNotCount) {
    SetTrial trial(on_trial(), std::nullopt);
    show(trial, start, seconds(60), 7);
    EXPECT_EQ(trial.verdict().state, library::TrialState::Trying);
    show(trial, start + seconds(60), seconds(20), 8);
    show(trial, start + seconds(80), seconds(1), 7);
    show(trial, start + seconds(82), seconds(29), 8);
    EXPECT_EQ(trial.verdict().state, library::TrialState::Trying);
}

TEST(SetTrial, AFaultRestoresTheLastGoodSet) {
    SetTrial trial(on_trial(), std::nullopt);
    show(trial, start, seconds(29));
    trial.shown(start + milliseconds(29'500), 8, "vase.fspack: it is damaged");
    EXPECT_EQ(trial.verdict(),
              (library::SetVerdict{8, library::TrialState::Bad, 1, "vase.fspack: it is damaged"}));
    EXPECT_EQ(trial.target().number, 7U);
    show(trial, start + seconds(30), seconds(60), 8); // it stays on show until the other one is ready
    show(trial, start + seconds(90), seconds(60), 7);
    EXPECT_EQ(trial.verdict().state, library::TrialState::Bad);
}

TEST(SetTrial, KeepsTheOldSetWhileTheStartCannotBeCounted) {
    SetTrial trial(on_trial(), std::nullopt);
    trial.note_kept(false);
    EXPECT_EQ(trial.target().number, 7U);
    trial.note_kept(true);
    EXPECT_EQ(trial.target().number, 8U);
    SetTrial alone({set_of(8), std::nullopt}, std::nullopt);
    alone.note_kept(false);
    EXPECT_EQ(alone.target().number, 8U);
    SetTrial good(on_trial(), library::SetVerdict{8, library::TrialState::Good, 1, ""});
    good.note_kept(false);
    EXPECT_EQ(good.target().number, 8U);
}

TEST(SetTrial, ABadSetStaysIfThereIsNoOther) {
    SetTrial trial({set_of(8), std::nullopt}, std::nullopt);
    EXPECT_FALSE(trial.on_trial());
    trial.refuse(8, "it is damaged");
    EXPECT_EQ(trial.verdict().state, library::TrialState::Bad);
    EXPECT_EQ(trial.target().number, 8U);
}

TEST(SetTrial, TheFourthStartWithoutAVerdictRestoresTheLastGoodSet) {
    std::optional<library::SetVerdict> kept;
    for (int begun = 1; begun <= library::max_starts; ++begun) {
        SetTrial trial(on_trial(), kept);
        show(trial, start, seconds(10)); // the exhibit crashes afterwards
        EXPECT_EQ(trial.target().number, 8U);
        EXPECT_EQ(trial.verdict().starts, begun);
        kept = trial.verdict();
    }
    SetTrial trial(on_trial(), kept);
    EXPECT_EQ(trial.target().number, 7U);
    EXPECT_EQ(trial.verdict().state, library::TrialState::Bad);
    EXPECT_NE(trial.verdict().reason.find("3 times"), std::string::npos) << trial.verdict().reason;
}

TEST(SetTrial, AGoodSetsStartsAreNotCounted) {
    const library::SetVerdict good{8, library::TrialState::Good, 2, ""};
    for (int begun = 0; begun < 10; ++begun) {
        SetTrial trial(on_trial(), good);
        EXPECT_EQ(trial.target().number, 8U);
        EXPECT_EQ(trial.verdict(), good);
    }
}

TEST(SetTrial, ANewSetIsOnTrialAndTheSameSetKeepsItsVerdict) {
    SetTrial trial({set_of(7), std::nullopt}, library::SetVerdict{7, library::TrialState::Good, 1, ""});
    trial.take(on_trial());
    EXPECT_EQ(trial.verdict(),
              (library::SetVerdict{8, library::TrialState::Trying, 1, ""})); // its first start
    EXPECT_EQ(trial.target().number, 8U);
    show(trial, start, seconds(30));
    trial.take({set_of(8), std::nullopt}); // the importer drops the previous set
    EXPECT_EQ(trial.verdict().state, library::TrialState::Good);
}

TEST(SetTrial, WithoutTrustShowsTheSetBeforeAndKeepsTheVerdict) {
    const library::SetVerdict good{8, library::TrialState::Good, 1, ""};
    SetTrial trial(on_trial(), good, Trust::Before);
    EXPECT_EQ(trial.target().number, 7U);
    EXPECT_EQ(trial.verdict(), good); // the next normal start shows it again
    EXPECT_EQ(trial.told().state, library::TrialState::Bad);
    EXPECT_FALSE(trial.on_trial());
    show(trial, start, seconds(60), 7);
    EXPECT_EQ(trial.target().number, 7U);
    trial.take({set_of(8), std::nullopt}); // the importer drops the previous set
    EXPECT_EQ(trial.target().number, 7U);
    trial.take({set_of(9), set_of(8)}); // a newer set arrives
    EXPECT_EQ(trial.target().number, 9U);
    EXPECT_EQ(trial.told(), trial.verdict());

    const SetTrial tried(on_trial(), library::SetVerdict{8, library::TrialState::Trying, 2, ""},
                         Trust::Before);
    EXPECT_EQ(tried.verdict().starts, 2); // the exhibit does not begin with it
    const SetTrial alone({set_of(8), std::nullopt}, std::nullopt, Trust::Before);
    EXPECT_EQ(alone.target().number, 8U);
    EXPECT_EQ(alone.told().state, library::TrialState::Trying);
}

TEST(SetTrial, IgnoresAVerdictOnAnotherSet) {
    const SetTrial trial(on_trial(), library::SetVerdict{9, library::TrialState::Bad, 3, "damaged"});
    EXPECT_EQ(trial.target().number, 8U);
    EXPECT_EQ(trial.verdict(), (library::SetVerdict{8, library::TrialState::Trying, 1, ""}));
}

TEST(SetTrial, FallsBackFromTheFirstSetToThePacksOfTheSettings) {
    SetTrial trial({set_of(1), library::InstalledSet()}, std::nullopt);
    EXPECT_TRUE(trial.on_trial());
    trial.refuse(1, "a pack cannot be shown");
    EXPECT_EQ(trial.target(), library::InstalledSet());
    trial.refuse(0, "neither can one of the settings'"); // there is no other set
    EXPECT_EQ(trial.target(), library::InstalledSet());
}

} // namespace
} // namespace frustumscreen::show
