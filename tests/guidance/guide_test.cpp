// When and in which form advice is given, with a simulated clock.
#include "app/guidance/guide.h"
#include "guided_props.h"

#include <gtest/gtest.h>

#include <random>
#include <set>
#include <string>

namespace frustumscreen::guidance {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

GuidedState standing_at(double x, double y, double yaw = 0.0) {
    GuidedState tracked_state;
    tracked_state.eye_m = {0.0, -0.55, 0.5};
    tracked_state.table_from_prop = {glm::angleAxis(yaw, glm::dvec3(0, 0, 1)), {x, y, 0.0}};
    return tracked_state;
}
const GuidedState good = standing_at(0.0, 0.0);
const GuidedState right_of_the_beam = standing_at(0.3, 0.0);

class GuideTest : public ::testing::Test {
protected:
    const Guidance& at(Nanoseconds time, const GuidedState& tracked_state, Sensing sensing = Sensing::Good,
                       bool may_speak = true) {
        for (; time_ < time; time_ += milliseconds(20)) {
            const Guidance& guidance = guide_.step(MonotonicTime(time_), tracked_state, sensing, may_speak);
            spoken_ += guidance.speak ? 1 : 0;
            stages_.insert(guidance.stage);
        }
        return guide_.step(MonotonicTime(time), tracked_state, sensing, may_speak);
    }
    Guide guide_{frustum_setup()};
    Nanoseconds time_{0};
    int spoken_ = 0;
    std::set<GuidanceStage> stages_;
};

TEST_F(GuideTest, IsQuietWhileEverythingIsLit) {
    EXPECT_EQ(at(seconds(30), good).stage, GuidanceStage::Quiet);
    EXPECT_EQ(stages_, std::set<GuidanceStage>{GuidanceStage::Quiet});
}

TEST_F(GuideTest, GoesFromPictureToTextToVoice) {
    at(seconds(1), good);
    EXPECT_EQ(at(milliseconds(1380), right_of_the_beam).stage, GuidanceStage::Quiet);
    EXPECT_EQ(at(milliseconds(1500), right_of_the_beam).stage, GuidanceStage::Picture);
    EXPECT_EQ(at(milliseconds(2800), right_of_the_beam).stage, GuidanceStage::Picture);
    EXPECT_EQ(at(milliseconds(3200), right_of_the_beam).stage, GuidanceStage::Text);
    EXPECT_EQ(spoken_, 0);
    EXPECT_EQ(at(milliseconds(6600), right_of_the_beam).stage, GuidanceStage::Voice);
    EXPECT_EQ(spoken_, 1);
    EXPECT_EQ(
        words_key(guide_.step(MonotonicTime(milliseconds(6600)), right_of_the_beam, Sensing::Good, true)),
        "slide_left");
}

TEST_F(GuideTest, IgnoresBriefProblems) {
    at(seconds(1), good);
    at(milliseconds(1300), right_of_the_beam);
    at(seconds(5), good);
    EXPECT_EQ(stages_, std::set<GuidanceStage>{GuidanceStage::Quiet});
}

TEST_F(GuideTest, IsQuietSoonAfterTheProblemIsSolved) {
    at(seconds(10), right_of_the_beam);
    EXPECT_EQ(at(milliseconds(10250), good).stage, GuidanceStage::Quiet);
}

/// A tracker's error neither lifts a prop nor presses it into the table.
TEST_F(GuideTest, DoesNotAskToStandUpAStandingProp) {
    for (const double height_m : {-0.006, 0.0, 0.006}) {
        for (const double lean_rad : {0.0, 0.04}) {
            GuidedState tracked_state = right_of_the_beam;
            tracked_state.table_from_prop.translation.z = height_m;
            tracked_state.table_from_prop.rotation = glm::angleAxis(lean_rad, glm::dvec3(1, 0, 0));
            guide_.forget();
            EXPECT_EQ(at(time_ + seconds(2), tracked_state).move.action, Action::Slide)
                << height_m << " " << lean_rad;
        }
    }
}

/// A prop at the border of the light, slightly more in the dark or in the light, with a tracker's noise.
TEST_F(GuideTest, DoesNotFlickerAtTheBorderOfTheLight) {
    double lit_m = 0.0;
    double dark_m = 0.3;
    while (dark_m - lit_m > 1e-6) {
        const double middle_m = 0.5 * (lit_m + dark_m);
        (guide_.reader().valid(standing_at(middle_m, 0.0)) ? lit_m : dark_m) = middle_m;
    }
    for (const double beyond_m : {-0.0003, 0.0003, 0.0006}) {
        std::mt19937 random(3);
        std::normal_distribution<double> noise(0.0, 0.0003);
        Guide guide(frustum_setup());
        bool shows = false;
        int changes = 0;
        int shown = 0;
        for (int frame = 0; frame < 3600; ++frame) {
            const GuidedState tracked_state = standing_at(lit_m + beyond_m + noise(random), noise(random));
            const MonotonicTime now{frame * milliseconds(1000) / 60};
            const bool before = shows;
            shows = guide.step(now, tracked_state, Sensing::Good, true).stage != GuidanceStage::Quiet;
            changes += shows != before ? 1 : 0;
            shown += shows ? 1 : 0;
        }
        EXPECT_LE(changes, 6) << beyond_m;
        EXPECT_EQ(shown > 3400, beyond_m > 0.0) << beyond_m << ": " << shown;
    }
}

TEST_F(GuideTest, SpeaksAfterGrowingPauses) {
    at(seconds(20), right_of_the_beam);
    EXPECT_EQ(spoken_, 2); // at 4.9 s and 8 s later
    at(seconds(120), right_of_the_beam);
    EXPECT_GE(spoken_, 4);
    EXPECT_LE(spoken_, 5); // 16, 32 and 60 s later
}

TEST_F(GuideTest, DoesNotSpeakOverSomethingElse) {
    at(seconds(60), right_of_the_beam, Sensing::Good, false);
    EXPECT_EQ(spoken_, 0);
    EXPECT_EQ(stages_.count(GuidanceStage::Text), 1U); // but it is shown
}

TEST_F(GuideTest, SpeaksAtOnceAndOnlyOnceOnRequest) {
    at(seconds(1), good);
    guide_.ask();
    EXPECT_EQ(at(seconds(2), good).stage, GuidanceStage::Quiet) << "nothing is to be done";
    EXPECT_EQ(at(seconds(2), right_of_the_beam).stage, GuidanceStage::Quiet);
    guide_.ask();
    EXPECT_EQ(words_key(at(seconds(2) + milliseconds(100), right_of_the_beam)), "slide_left");
    EXPECT_EQ(guide_.step(MonotonicTime(time_), right_of_the_beam, Sensing::Good, true).stage,
              GuidanceStage::Voice);
    EXPECT_EQ(spoken_, 1);
    spoken_ = 0;
    EXPECT_EQ(at(seconds(9), right_of_the_beam).stage, GuidanceStage::Voice);
    EXPECT_EQ(spoken_, 0) << "it is not said again before its pause";
    guide_.ask();
    EXPECT_FALSE(at(seconds(9), right_of_the_beam, Sensing::Good, false).speak) << "it is being said already";
}

TEST_F(GuideTest, DoesNotSpeakWhileTheAdviceIsFollowed) {
    // 2 cm a second towards the beam: slow, but the advice is followed.
    for (int k = 0; k < 8; ++k) {
        at(milliseconds(1000 * k), standing_at(0.40 - 0.02 * k, 0.0));
    }
    EXPECT_EQ(stages_.count(GuidanceStage::Voice), 0U);
    EXPECT_EQ(stages_.count(GuidanceStage::Picture), 1U) << "it is advised";
}

TEST_F(GuideTest, NamesALostPropOrHead) {
    EXPECT_EQ(words_key(at(seconds(3), good, Sensing::PropLost)), "uncover");
    EXPECT_EQ(words_key(at(seconds(6), good, Sensing::HeadLost)), "show_your_head");
    EXPECT_EQ(at(seconds(7), good).stage, GuidanceStage::Quiet);
}

TEST_F(GuideTest, RanksTrackerProblemsAgainstDarkFaces) {
    EXPECT_EQ(words_key(at(seconds(3), good, Sensing::MetalNear)), "away_from_metal");
    EXPECT_EQ(words_key(at(seconds(6), right_of_the_beam, Sensing::MetalNear)), "slide_left");
    EXPECT_EQ(words_key(at(seconds(9), right_of_the_beam, Sensing::HeadLost)), "slide_left");
    EXPECT_EQ(words_key(at(seconds(12), right_of_the_beam, Sensing::TrackerAway)), "wait_tracker");
    EXPECT_EQ(words_key(at(seconds(15), right_of_the_beam, Sensing::PropLost)), "slide_back_to_light");
}

TEST_F(GuideTest, RestartsItsPausesForTheNextVisitor) {
    at(seconds(120), right_of_the_beam);
    const int before = spoken_;
    guide_.forget();
    at(seconds(126), right_of_the_beam);
    EXPECT_EQ(spoken_, before + 1); // without the long pause of the previous advice
}

TEST_F(GuideTest, AsksToStandUpAnUpsideDownProp) {
    GuidedState upside_down = good;
    upside_down.table_from_prop = {glm::angleAxis(3.1, glm::dvec3(1, 0, 0)), {0.0, 0.0, 0.155}};
    EXPECT_EQ(words_key(at(seconds(1), upside_down)), "stand_upright");
}

/// The visitor's own left and right, from every side of the table.
TEST(AdviceWords, UseTheVisitorsDirections) {
    for (int side = 0; side < 4; ++side) {
        const glm::dquat turn = glm::angleAxis(0.5 * std::numbers::pi * side, glm::dvec3(0, 0, 1));
        Guidance guidance;
        guidance.stage = GuidanceStage::Picture;
        guidance.tracked_state.eye_m = turn * glm::dvec3(0.0, -0.6, 0.5);
        const auto key = [&](const glm::dvec3& way) {
            guidance.move = {Action::Slide, turn * way};
            return std::string(words_key(guidance));
        };
        EXPECT_EQ(key({-0.2, 0.01, 0.0}), "slide_left");
        EXPECT_EQ(key({0.04, 0.01, 0.0}), "slide_right_a_little");
        EXPECT_EQ(key({0.0, 0.3, 0.0}), "slide_farther");
        EXPECT_EQ(key({0.01, -0.03, 0.0}), "slide_nearer_a_little");
    }
}

} // namespace
} // namespace frustumscreen::guidance
