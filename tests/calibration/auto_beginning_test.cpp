// How a calibration by a camera begins, goes over to the other ways, and ends where nobody is there.
#include "app/calibration/procedure/auto_procedure.h"
#include "app/programs/calibrate/calibration_way.h"
#include "app/programs/calibrate/table_pictures.h"
#include "tests/calibration/expect_sentences.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

namespace frustumscreen::calibration {
namespace {

constexpr geometry::FrustumSize usual_prop{0.30, 0.08, 0.155};

/// The beginning of a procedure, without pictures, tracker and tags.
struct Beginning {
    explicit Beginning(bool crosses_follow) : procedure(*board_for(usual_prop), plan(crosses_follow)) {}
    static AutoPlan plan(bool crosses_follow) {
        AutoPlan plan;
        plan.stripes = stripes_for(640, 400);
        plan.crosses_follow = crosses_follow;
        return plan;
    }
    void wait(double seconds, camera::CameraState state) {
        for (const MonotonicTime end = input.now + std::chrono::milliseconds(std::llround(1e3 * seconds));
             input.now < end;) {
            input.now += std::chrono::milliseconds(100);
            input.camera = state;
            procedure.step(input);
        }
    }
    /// The camera keeps sending one picture, whatever is shown.
    void see(camera::CameraFrame frame, double seconds) {
        for (const MonotonicTime end = input.now + std::chrono::milliseconds(std::llround(1e3 * seconds));
             input.now < end;) {
            input.now += std::chrono::milliseconds(20);
            if (!input.lit || input.lit->number != procedure.number()) {
                input.lit = CalibrationInput::Lit{procedure.number(), input.now};
            }
            frame.time = input.now;
            ++frame.number;
            input.frame = &frame;
            procedure.step(input);
        }
        input.frame = nullptr;
    }
    void press(bool AutoProcedure::Input::*button) {
        input.*button = true;
        procedure.step(input);
        input.*button = false;
    }
    AutoProcedure procedure;
    AutoProcedure::Input input;
};
constexpr auto next = &AutoProcedure::Input::next;
constexpr auto back = &AutoProcedure::Input::back;

TEST(AutoProcedure, BackGoesOnToTheCrossesOnlyIfTheyFollow) {
    for (const bool follow : {false, true}) {
        Beginning table(follow);
        table.wait(0.1, camera::CameraState::Running);
        EXPECT_EQ(programs::table_words(table.procedure).key,
                  follow ? "calibration.by_camera" : "calibration.begin");
        table.press(back);
        EXPECT_EQ(table.procedure.stage(), follow ? CalibrationStage::GoesOn : CalibrationStage::Left);
    }
    AutoProcedure refused(*board_for(usual_prop), Beginning::plan(true), "the folder is full");
    EXPECT_EQ(programs::table_words(refused).key, "") << "there is none for every reason";
    AutoProcedure::Input pressed;
    pressed.back = true;
    refused.step(pressed);
    EXPECT_EQ(refused.stage(), CalibrationStage::Left) << "it was measured, and could not be kept";
}

TEST(AutoProcedure, ReportsACameraFaultAndGoesOnWithBack) {
    for (const camera::CameraState fault :
         {camera::CameraState::NotConnected, camera::CameraState::Dark, camera::CameraState::InUse}) {
        Beginning table(true);
        table.wait(1.5, fault); // cameras take as long to start
        EXPECT_EQ(table.procedure.word(), AutoPrompt::None);
        table.wait(1.0, fault);
        EXPECT_EQ(table.procedure.word(), AutoPrompt::CameraFault);
        EXPECT_EQ(programs::table_words(table.procedure).key, "calibration.no_camera");
        std::string sentence(camera::sentence_of(fault));
        sentence.erase(0, 1); // begins with a capital letter
        EXPECT_NE(programs::table_words(table.procedure).lines[1].find(sentence), std::string::npos);
        table.press(next);
        EXPECT_EQ(table.procedure.stage(), CalibrationStage::Begin);
        table.wait(0.1, camera::CameraState::Running); // the fault is repaired
        EXPECT_EQ(programs::table_words(table.procedure).key, "calibration.by_camera");
        table.wait(2.5, fault);
        table.press(back);
        EXPECT_EQ(table.procedure.stage(), CalibrationStage::GoesOn);
        table.wait(3600.0, fault);
        EXPECT_EQ(table.procedure.stage(), CalibrationStage::GoesOn);
    }
    Beginning forgotten(true);
    forgotten.wait(62.0, camera::CameraState::NotConnected);
    EXPECT_EQ(forgotten.procedure.stage(), CalibrationStage::Left);
}

TEST(AutoProcedure, ReportsAMissingCameraButNotDarknessDuringDelay) {
    for (const bool follow : {false, true}) {
        const CalibrationStage after = follow ? CalibrationStage::GoesOn : CalibrationStage::Begin;
        Beginning lost(follow);
        lost.wait(0.1, camera::CameraState::Running);
        lost.press(next);
        ASSERT_EQ(lost.procedure.stage(), CalibrationStage::Delay);
        EXPECT_EQ(programs::table_words(lost.procedure).key, "calibration.look_at_light");
        lost.wait(0.5, camera::CameraState::NotConnected);
        EXPECT_EQ(programs::table_words(lost.procedure).key,
                  follow ? "calibration.no_camera" : "calibration.camera_fault");
        lost.press(back);
        EXPECT_EQ(lost.procedure.stage(), after);

        Beginning well(follow);
        well.wait(0.1, camera::CameraState::Running);
        well.press(next);
        well.wait(0.5, camera::CameraState::Dark); // while dark is shown
        EXPECT_EQ(well.procedure.word(), AutoPrompt::None);
        well.press(back);
        EXPECT_EQ(well.procedure.stage(), CalibrationStage::Begin);
        well.wait(1.0, camera::CameraState::Dark); // it cannot see the words' light yet
        EXPECT_EQ(well.procedure.word(), AutoPrompt::None);
    }
}

TEST(AutoProcedure, ReportsNoLightIfTheCameraLooksElsewhere) {
    for (const bool follow : {false, true}) {
        Beginning elsewhere(follow);
        elsewhere.wait(0.1, camera::CameraState::Running);
        elsewhere.press(next);
        const camera::CameraFrame same{{}, 0, 8, 8, std::vector<std::uint8_t>(64, 90)};
        elsewhere.see(same, 30.0);
        ASSERT_EQ(elsewhere.procedure.stage(), CalibrationStage::Delay);
        EXPECT_EQ(elsewhere.procedure.word(), AutoPrompt::NoLight);
        EXPECT_EQ(programs::table_words(elsewhere.procedure).key, "calibration.no_light");
        elsewhere.press(next); // it measures again
        EXPECT_EQ(elsewhere.procedure.word(), AutoPrompt::None);
        elsewhere.see(same, 30.0);
        EXPECT_EQ(elsewhere.procedure.word(), AutoPrompt::NoLight);
        elsewhere.press(back);
        EXPECT_EQ(elsewhere.procedure.stage(), follow ? CalibrationStage::GoesOn : CalibrationStage::Begin);
    }
}

TEST(AutoProcedure, EveryMessageKeyHasASentence) {
    std::set<std::string> said;
    for (int word = 0; word <= static_cast<int>(AutoPrompt::TooFew); ++word) {
        for (const Posture wished : {Posture::Flat, Posture::Block, Posture::Leaning}) {
            for (const bool may_go_on : {false, true}) {
                said.insert(std::string(programs::key_of(static_cast<AutoPrompt>(word), wished, may_go_on)));
            }
        }
    }
    EXPECT_EQ(said.size(), 17U);
    said.insert({"calibration.by_camera", "calibration.look_at_light", "calibration.more_rests",
                 "calibration.repeat"});
    expect_sentences(said);
}

TEST(CalibrationWays, OrderIsTouchUpThenCameraThenCrosses) {
    using enum programs::CalibrationWay;
    using Ways = std::vector<programs::CalibrationWay>;
    EXPECT_EQ(programs::ways_through(true, true), (Ways{TouchUp, Camera, Crosses}));
    EXPECT_EQ(programs::ways_through(true, false), (Ways{TouchUp, Crosses}));
    EXPECT_EQ(programs::ways_through(false, true), (Ways{Camera, Crosses}));
    EXPECT_EQ(programs::ways_through(false, false), (Ways{Crosses}));
}

TEST(AutoProcedure, TimesOutAtTheBeginning) {
    AutoPlan plan;
    plan.stripes = stripes_for(640, 400);
    AutoProcedure procedure(*board_for(usual_prop), plan);
    AutoProcedure::Input input;
    procedure.step(input);
    input.now += AutoProcedure::to_begin + std::chrono::seconds(1);
    procedure.step(input);
    EXPECT_EQ(procedure.stage(), CalibrationStage::Left);
}

} // namespace
} // namespace frustumscreen::calibration
