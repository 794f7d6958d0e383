// The exhibit without visitors, and when the tracker fails a visitor.

#include "tests/exhibit/exhibits.h"

#include <gtest/gtest.h>

#include <array>

namespace frustumscreen::exhibit {
namespace {

using sample::start;
using std::chrono::milliseconds;
using std::chrono::seconds;

const std::vector<std::string> keys{"attract_line",      "uncover",         "slide_back_to_light",
                                    "show_your_head",    "away_from_metal", "wait_tracker",
                                    "fault.no_artifact", "slide_left"};

class RestTest : public ::testing::Test {
protected:
    static Exhibit make(std::size_t artifacts) {
        const std::vector<std::string> languages{"en", "de"};
        ExhibitPlace place = sample::shipped_place();
        place.words = {sample::words_of("de", keys), sample::words_of("en", keys)};
        place.rest = seconds(30);
        const CatalogueEntry entry{languages, {languages.size(), {{0.2, 0.05}, {0.1, 0.1}}}};
        return {Catalogue(artifacts, entry), place, "en", start};
    }
    void SetUp() override { tracked_state.eye_m = {0.0, -0.55, 0.5}; }

    /// Runs for `time`; with `lost`, the prop's pose is unknown.
    void wait(Nanoseconds time, std::span<const settings::Command> commands = {}) {
        const MonotonicTime end = now + time;
        for (std::span<const settings::Command> pressed = commands; now < end; pressed = {}) {
            now += milliseconds(20);
            tracked_state.time = now;
            tracked_state.prop_age = lost ? now - *lost : Nanoseconds(0);
            tracked_state.prop_known = tracked_state.prop_age <= seconds(1);
            before = shown;
            shown = exhibit.step(now, pressed, tracked_state);
            said += shown.says ? 1 : 0;
            EXPECT_TRUE(!shown.says || (shown.advice && shown.advice->word == *shown.says));
        }
    }
    void slide(double x_m) { tracked_state.table_from_prop.translation.x = x_m; }
    void lose() { lost = now; }
    /// The key of the sentence on the table; empty: none.
    [[nodiscard]] std::string text() const { return shown.advice ? keys.at(shown.advice->word.text) : ""; }

    tracking::TrackedState tracked_state;
    MonotonicTime now = start;
    std::optional<MonotonicTime> lost;
    Presentation before;
    Presentation shown;
    int said = 0;
    Exhibit exhibit = make(3);
};

TEST_F(RestTest, StartsInTheAttractState) {
    wait(seconds(1));
    EXPECT_EQ(shown.state, State::Attract);
    EXPECT_EQ(text(), "attract_line");
    EXPECT_EQ(shown.advice->word.language, 1U); // the house's language
    EXPECT_EQ(shown.advice->brightness, 1.0);
}

TEST_F(RestTest, ShowsArtifactsInTurnWithoutSpeech) {
    std::vector<std::size_t> turns;
    for (int k = 0; k < 7; ++k) {
        turns.push_back(shown.artifact);
        wait(Selection::turn_time);
        EXPECT_EQ(text(), "attract_line");
    }
    EXPECT_EQ(turns, (std::vector<std::size_t>{0, 0, 1, 2, 0, 1, 2}));
    EXPECT_EQ(said, 0);
}

TEST_F(RestTest, FirstTouchKeepsTheArtifactAndFadesTheLine) {
    wait(seconds(50));
    ASSERT_EQ(shown.artifact, 2U);
    slide(0.01);
    double line = shown.advice->brightness;
    for (int k = 0; k < 100; ++k) {
        wait(milliseconds(20));
        EXPECT_EQ(shown.state, State::View);
        EXPECT_EQ(shown.artifact, 2U);
        EXPECT_EQ(shown.brightness, 1.0);
        EXPECT_EQ(shown.table_from_prop.translation, tracked_state.table_from_prop.translation);
        const double next = shown.advice ? shown.advice->brightness : 0.0;
        EXPECT_LE(next, line);
        EXPECT_GE(next, line - 0.13); // 1.5 times 20 of 250 ms
        line = next;
    }
    EXPECT_EQ(line, 0.0);
    EXPECT_TRUE(shown.caption);
    EXPECT_EQ(shown.caption->brightness, 1.0);
}

TEST_F(RestTest, FirstPressTakesEffect) {
    wait(seconds(1));
    wait(seconds(1), std::array{settings::Command::NextArtifact});
    EXPECT_EQ(shown.state, State::View);
    EXPECT_EQ(shown.artifact, 1U);
}

TEST_F(RestTest, RestoresTheDefaultLanguage) {
    wait(seconds(1), std::array{settings::Command::NextLanguage});
    EXPECT_EQ(shown.language, "de");
    wait(seconds(28));
    EXPECT_EQ(shown.language, "de");
    wait(seconds(3));
    EXPECT_EQ(shown.state, State::Attract);
    EXPECT_EQ(shown.language, "en");
    EXPECT_EQ(shown.advice->word.language, 1U);
}

/// A tracker's noise at rest does not count as a visitor; a sentence being spoken ends when the visitor goes.
TEST_F(RestTest, DoesNotSpeakAfterTheVisitorLeaves) {
    wait(seconds(1));
    slide(0.3); // dark
    wait(seconds(7));
    EXPECT_EQ(shown.state, State::Guide);
    wait(seconds(30));
    EXPECT_EQ(shown.state, State::Attract);
    EXPECT_FALSE(shown.sign);
    const int before_rest = said;
    EXPECT_GT(before_rest, 0) << "nothing could be said";
    wait(seconds(120));
    EXPECT_EQ(said, before_rest);
}

TEST_F(RestTest, AsksForALostPropInWordsThenBySpeech) {
    wait(seconds(1));
    slide(0.02);
    wait(seconds(1));
    lose();
    wait(milliseconds(1900));
    EXPECT_EQ(shown.state, State::View);
    wait(seconds(3));
    EXPECT_EQ(shown.state, State::Degraded);
    EXPECT_TRUE(shown.attracts);
    EXPECT_EQ(text(), "uncover");
    EXPECT_EQ(said, 0);
    wait(seconds(4));
    EXPECT_EQ(said, 1);
    lost.reset();
    wait(seconds(2));
    EXPECT_EQ(shown.state, State::View);
    EXPECT_FALSE(shown.attracts);
    EXPECT_EQ(text(), "");
}

/// The artifact turns, and the words beside it do not move.
TEST_F(RestTest, WordsStayStillBesideATurningArtifact) {
    wait(seconds(1));
    slide(0.02);
    wait(seconds(1));
    lose();
    wait(seconds(6));
    ASSERT_EQ(text(), "uncover");
    const glm::dvec2 place = shown.advice->rectangle.centre_m;
    for (int k = 0; k < 20; ++k) {
        wait(seconds(1));
        ASSERT_EQ(text(), "uncover");
        EXPECT_EQ(shown.advice->rectangle.centre_m, place);
        EXPECT_EQ(shown.advice->brightness, 1.0);
    }
}

TEST_F(RestTest, RestsWithALostPropToo) {
    wait(seconds(1));
    slide(0.02);
    wait(seconds(1));
    lose();
    wait(seconds(31));
    EXPECT_EQ(shown.state, State::Attract);
    EXPECT_TRUE(shown.attracts);
    EXPECT_EQ(text(), "attract_line");
    wait(seconds(1),
         std::array{settings::Command::NextArtifact}); // the prop's pose is unknown, but a visitor is present
    EXPECT_EQ(shown.state, State::Degraded);
}

TEST_F(RestTest, AsksToSlideBackAPropLostOutsideTheLight) {
    wait(seconds(1));
    slide(0.36);
    wait(milliseconds(100));
    lose();
    wait(seconds(6));
    EXPECT_EQ(text(), "slide_back_to_light");
}

TEST_F(RestTest, AsksToWaitWhenTheTrackerDoesNotAnswer) {
    wait(seconds(1));
    slide(0.02);
    wait(milliseconds(100));
    lose();
    tracked_state.tracker = tracker::TrackerHealth::Away;
    wait(seconds(6));
    EXPECT_EQ(text(), "wait_tracker");
}

TEST_F(RestTest, WarnsOfMetalWhileThePictureIsWhole) {
    wait(seconds(1));
    slide(0.02);
    tracked_state.tracker = tracker::TrackerHealth::MetalNear;
    wait(seconds(3));
    EXPECT_EQ(shown.state, State::Guide);
    EXPECT_EQ(text(), "away_from_metal");
    EXPECT_FALSE(shown.sign);
    slide(0.3);
    wait(seconds(1));
    EXPECT_TRUE(shown.sign); // a dark face has priority
}

TEST_F(RestTest, AsksForALostHeadOnlyDuringPlay) {
    tracked_state.head_known = true;
    wait(seconds(1));
    slide(0.02);
    wait(seconds(1));
    tracked_state.head_known = false;
    wait(seconds(10));
    EXPECT_EQ(shown.state, State::View); // the visitor is gone, or waiting
    slide(0.04);
    wait(seconds(3));
    EXPECT_EQ(shown.state, State::Guide);
    EXPECT_EQ(text(), "show_your_head");
    tracked_state.head_known = true;
    wait(seconds(1));
    EXPECT_EQ(shown.state, State::View);
}

TEST_F(RestTest, DoesNotAskForAHeadThatWasNeverKnown) {
    wait(seconds(1));
    slide(0.02);
    wait(seconds(10));
    EXPECT_EQ(shown.state, State::View);
}

TEST_F(RestTest, StaffModeEndsInTheCurrentState) {
    wait(seconds(1));
    slide(0.02);
    wait(seconds(1));
    wait(seconds(1), std::array{settings::Command::StaffMode});
    EXPECT_EQ(shown.state, State::Staff);
    EXPECT_EQ(shown.before_staff, State::View);
    lose();
    wait(seconds(5));
    EXPECT_EQ(shown.state, State::Staff);
    wait(milliseconds(20), std::array{settings::Command::NextArtifact});
    EXPECT_EQ(shown.state, State::Staff);
    wait(milliseconds(20), std::array{settings::Command::StaffMode});
    EXPECT_EQ(shown.state, State::Degraded);
    wait(seconds(1));
    EXPECT_EQ(shown.artifact, 0U);
}

TEST_F(RestTest, ShowsAFaultWithoutArtifacts) {
    exhibit = make(0);
    wait(seconds(1));
    EXPECT_EQ(shown.state, State::Fault);
    EXPECT_EQ(text(), "fault.no_artifact");
    wait(seconds(120), std::array{settings::Command::StaffMode});
    EXPECT_EQ(shown.state, State::Fault);
    EXPECT_EQ(said, 0);
}

TEST_F(RestTest, RestoresTheDefaultLanguageInTheFaultState) {
    wait(seconds(1), std::array{settings::Command::NextLanguage});
    exhibit.note(std::array{ArtifactState::Unusable, ArtifactState::Unusable, ArtifactState::Unusable});
    wait(seconds(2));
    EXPECT_EQ(shown.state, State::Fault);
    EXPECT_EQ(text(), "fault.no_artifact");
    EXPECT_EQ(shown.advice->word.language, 0U);
    EXPECT_EQ(shown.brightness, 0.0);
    EXPECT_FALSE(shown.caption || shown.placeholder);
    wait(seconds(30));
    EXPECT_EQ(shown.advice->word.language, 1U);
    exhibit.note(std::array{ArtifactState::Unusable, ArtifactState::Ready, ArtifactState::Unusable});
    wait(seconds(2));
    EXPECT_EQ(shown.state, State::Attract);
    EXPECT_EQ(shown.artifact, 1U);
    EXPECT_EQ(shown.brightness, 1.0);
}

} // namespace
} // namespace frustumscreen::exhibit
