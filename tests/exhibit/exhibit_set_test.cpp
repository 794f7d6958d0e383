// Another set of artifacts replaces the current one while the exhibit runs: when, and what stays.

#include "tests/exhibit/exhibits.h"

#include <gtest/gtest.h>

#include <vector>

namespace frustumscreen::exhibit {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

Catalogue artifacts(std::size_t count, const std::vector<std::string>& languages) {
    const CatalogueEntry entry{languages, {languages.size(), {{0.2, 0.05}, {0.1, 0.1}}}};
    return Catalogue(count, entry);
}

class AnotherSet : public ::testing::Test {
protected:
    const Presentation& run(Nanoseconds length, std::vector<settings::Command> commands = {}) {
        const MonotonicTime end = now + length;
        while (now < end) {
            now += milliseconds(20);
            tracking::TrackedState tracked_state = sample::tracked_state(now);
            tracked_state.table_from_prop.translation.x = x_m;
            shown = exhibit.step(now, commands, tracked_state);
            commands.clear();
        }
        return shown;
    }
    void visit() {
        run(seconds(1), {settings::Command::NextArtifact});
        ASSERT_EQ(shown.state, State::View);
    }
    /// The time that the set takes to leave from now on, at most `longest`.
    Nanoseconds leaves_within(Nanoseconds longest) {
        const MonotonicTime from = now;
        while (!exhibit.set_has_left() && now - from < longest) {
            run(milliseconds(20));
        }
        return now - from;
    }

    double x_m = 0.0;
    MonotonicTime now = sample::start;
    Exhibit exhibit = sample::exhibit(3, {"en", "de"});
    Presentation shown;
};

TEST_F(AnotherSet, FadesInKeepingLanguageAndState) {
    visit();
    run(seconds(1), {settings::Command::NextLanguage});
    ASSERT_EQ(shown.language, "de");
    const double before = shown.brightness;
    exhibit.await_set(true);
    double last = before;
    std::vector<double> light;
    while (!exhibit.set_has_left()) {
        run(milliseconds(20));
        light.push_back(shown.brightness);
        EXPECT_LE(shown.brightness, last);
        EXPECT_EQ(shown.set_share > 0.0, shown.brightness > 0.0);
        last = shown.brightness;
        ASSERT_LE(light.size(), 100U);
    }
    EXPECT_EQ(last, 0.0);
    EXPECT_FALSE(shown.caption);
    EXPECT_GT(light.size(), 10U); // a fade, not a jump
    const Catalogue old = exhibit.show_set(artifacts(2, {"fr", "de"}), {}, {}, 1, now);
    EXPECT_EQ(old.size(), 3U);
    run(milliseconds(20));
    EXPECT_LT(shown.brightness, 0.1);
    EXPECT_EQ(shown.artifact, 1U);
    run(seconds(1));
    EXPECT_EQ(shown.brightness, before);
    EXPECT_EQ(shown.set_share, 1.0);
    EXPECT_EQ(shown.language, "de");
    EXPECT_EQ(shown.state, State::View);
    run(seconds(1), {settings::Command::NextArtifact});
    EXPECT_EQ(shown.artifact, 0U); // the set has two
}

TEST_F(AnotherSet, ReturnsToTheDefaultLanguageWhenAvailable) {
    visit();
    exhibit.await_set(true);
    leaves_within(seconds(1));
    static_cast<void>(exhibit.show_set(artifacts(1, {"fr"}), {}, {}, 0, now));
    run(seconds(1));
    EXPECT_EQ(shown.language, "fr"); // the set has no other
    exhibit.await_set(true);
    leaves_within(seconds(1));
    static_cast<void>(exhibit.show_set(artifacts(1, {"fr", "en"}), {}, {}, 0, now));
    run(seconds(1));
    EXPECT_EQ(shown.language, "en");
}

TEST_F(AnotherSet, WaitsForTheNextTurnWithoutAVisitor) {
    while (shown.state != State::Attract || shown.artifact == 0) {
        run(milliseconds(20));
        ASSERT_LT(now, sample::start + seconds(200));
    }
    const std::size_t artifact = shown.artifact; // shown a moment ago
    run(seconds(3));
    exhibit.await_set(true);
    EXPECT_GT(leaves_within(seconds(30)), seconds(16));
    EXPECT_TRUE(exhibit.set_has_left());
    EXPECT_EQ(shown.artifact, artifact); // no other one was shown in between
}

TEST_F(AnotherSet, ReplacesTheSetAtOnceForAVisitor) {
    visit();
    exhibit.await_set(true);
    EXPECT_LE(leaves_within(seconds(5)), fade_time + milliseconds(60));
}

TEST_F(AnotherSet, WaitsForAChangeOfArtifactToFinish) {
    visit();
    exhibit.await_set(true);
    run(milliseconds(20), {settings::Command::NextArtifact});
    // Out and in for the change of artifact, and out for the set.
    const Nanoseconds time = leaves_within(seconds(5));
    EXPECT_GE(time, 3 * fade_time - milliseconds(60));
    EXPECT_LE(time, 3 * fade_time + milliseconds(60));
}

TEST_F(AnotherSet, IsNotShownUnlessReady) {
    visit();
    exhibit.await_set(false);
    run(seconds(5));
    EXPECT_FALSE(exhibit.leaves_set());
    EXPECT_EQ(shown.set_share, 1.0);
}

TEST_F(AnotherSet, WaitsForSpeechUpToALimit) {
    visit();
    exhibit.hear(true);
    exhibit.await_set(true);
    run(seconds(10));
    EXPECT_FALSE(exhibit.leaves_set());
    exhibit.hear(false);
    EXPECT_LE(leaves_within(seconds(5)), fade_time + milliseconds(60));

    static_cast<void>(exhibit.show_set(artifacts(2, {"en"}), {}, {}, 0, now));
    run(seconds(1));
    exhibit.hear(true); // and never ends
    exhibit.await_set(true);
    const Nanoseconds waited = leaves_within(seconds(60));
    EXPECT_GE(waited, SetChange::longest_wait);
    EXPECT_LE(waited, SetChange::longest_wait + seconds(1));
}

TEST_F(AnotherSet, KeepsItsWaitingTimeWhileItLoads) {
    visit();
    exhibit.hear(true); // and never ends
    exhibit.await_set(true);
    const MonotonicTime from = now;
    while (!exhibit.leaves_set() && now - from < seconds(60)) {
        exhibit.await_set((now - from) % seconds(2) >= milliseconds(100));
        run(milliseconds(20));
    }
    EXPECT_GE(now - from, SetChange::longest_wait);
    EXPECT_LE(now - from, SetChange::longest_wait + seconds(1));
}

TEST_F(AnotherSet, RestartsTheWaitAfterAWithdrawnSet) {
    visit();
    exhibit.hear(true);
    exhibit.await_set(true);
    run(seconds(15));
    exhibit.await_no_set();
    run(seconds(15));
    EXPECT_FALSE(exhibit.leaves_set());
    exhibit.await_set(true);
    const Nanoseconds waited = leaves_within(seconds(60));
    EXPECT_GE(waited, SetChange::longest_wait);
    EXPECT_LE(waited, SetChange::longest_wait + fade_time + milliseconds(60));
}

TEST_F(AnotherSet, KeepsTheStaffPatternOnScreen) {
    visit();
    run(milliseconds(20), {settings::Command::StaffMode});
    ASSERT_TRUE(shown.staff);
    exhibit.await_set(true);
    EXPECT_LT(leaves_within(seconds(1)), seconds(1));
    static_cast<void>(exhibit.show_set(artifacts(2, {"en"}), {}, {}, 0, now));
    EXPECT_TRUE(run(seconds(1)).staff);
}

} // namespace
} // namespace frustumscreen::exhibit
