// A technician at the table, simulated report by report: which touches are taken, which are not, and that
// none is lost.
#include "app/calibration/procedure/touch_procedure.h"
#include "tests/calibration/simulated_touches.h"

#include <gtest/gtest.h>

namespace frustumscreen::calibration {
namespace {

using Input = TouchProcedure::Input;

constexpr Nanoseconds tick = std::chrono::milliseconds(20); // 50 reports a second
const std::vector<TouchResidual> three_residuals{{1e-4, 0.1}, {5e-4, 0.5}, {2e-4, 0.2}};

class Procedure : public ::testing::Test {
protected:
    Procedure() : procedure(crosses()) { press(true); } // begins the procedure
    static std::vector<Cross> crosses() {
        return {{{100, 100}, 0.0, 0.0}, {{900, 100}, 0.0, 1.5}, {{500, 600}, 0.05, 0.0}};
    }
    /// The prop's pose on the cross `k`.
    static geometry::RigidTransform on(std::size_t k) {
        return {glm::angleAxis(0.5 * static_cast<double>(k), glm::dvec3(0, 0, 1)),
                {0.1 * static_cast<double>(k), 0.05, 0.1}};
    }
    void press(bool next) {
        now += tick;
        procedure.step({now, std::nullopt, next, !next});
    }
    /// Reports a pose for `time`, each with noise.
    void rest(const geometry::RigidTransform& pose, Nanoseconds time, double noise_m = 2e-4) {
        for (const MonotonicTime end = now + time; now < end;) {
            now += tick;
            geometry::RigidTransform report = pose;
            report.translation += noise_m * numbers.normals();
            procedure.step({now, report, false, false});
        }
    }
    void touch(std::size_t k) {
        press(true);
        rest(on(k), TouchProcedure::rest + 2 * tick);
    }

    TouchProcedure procedure;
    simulators::SeededNumbers numbers{5};
    MonotonicTime now = from_microseconds(1'000'000);
};

TEST_F(Procedure, EachRestBecomesATouchAtTheMeanReport) {
    for (std::size_t k = 0; k < 3; ++k) {
        EXPECT_EQ(procedure.stage(), CalibrationStage::Place);
        EXPECT_EQ(procedure.at(), k);
        rest(on(k), tick * 10);
        EXPECT_EQ(procedure.stage(), CalibrationStage::Place) << "nothing is taken before Next";
        touch(k);
        EXPECT_EQ(procedure.word(), TouchPrompt::Taken);
    }
    ASSERT_EQ(procedure.stage(), CalibrationStage::Solve);
    const Touches touches = procedure.touches();
    ASSERT_EQ(touches.size(), 3U);
    for (std::size_t k = 0; k < 3; ++k) {
        // Some 50 reports with noise of 0.2 mm: four standard deviations of their mean.
        EXPECT_LT(glm::distance(touches[k].tracker_from_sensor.translation, on(k).translation),
                  4 * 2e-4 * std::sqrt(3.0 / 50.0));
        EXPECT_NEAR(std::abs(glm::dot(touches[k].tracker_from_sensor.rotation, on(k).rotation)), 1.0, 1e-12);
        EXPECT_EQ(touches[k].pixel, crosses()[k].pixel);
        EXPECT_EQ(touches[k].block_m, crosses()[k].block_m);
    }
}

TEST_F(Procedure, RestartsTheRestIfThePropMoves) {
    press(true);
    rest(on(0), TouchProcedure::rest / 2);
    geometry::RigidTransform pushed = on(0);
    pushed.translation.x += 0.01;
    rest(pushed, TouchProcedure::rest / 2);
    EXPECT_EQ(procedure.stage(), CalibrationStage::HoldStill);
    EXPECT_EQ(procedure.word(), TouchPrompt::Moved);
    rest(pushed, TouchProcedure::rest);
    EXPECT_EQ(procedure.at(), 1U);
    press(true); // a rotation alone counts too
    rest(on(1), TouchProcedure::rest / 2);
    geometry::RigidTransform turned = on(1);
    turned.rotation = glm::angleAxis(0.1, glm::dvec3(0, 0, 1)) * turned.rotation;
    rest(turned, tick * 2);
    EXPECT_EQ(procedure.word(), TouchPrompt::Moved);
}

TEST_F(Procedure, ReportsAPropThatIsNotTracked) {
    press(true);
    rest(on(0), TouchProcedure::rest / 2);
    now += TouchProcedure::timeout + tick;
    procedure.step({now, std::nullopt, false, false});
    EXPECT_EQ(procedure.stage(), CalibrationStage::Place);
    EXPECT_EQ(procedure.word(), TouchPrompt::NotSeen);
    touch(0);
    EXPECT_EQ(procedure.at(), 1U);
}

TEST_F(Procedure, ATrackerOfOneReportASecondTakesLonger) {
    press(true);
    for (int k = 0; k < 4; ++k) {
        now += std::chrono::seconds(1);
        procedure.step({now, on(0), false, false});
        EXPECT_EQ(procedure.stage(), CalibrationStage::HoldStill) << k;
    }
    now += std::chrono::seconds(1);
    procedure.step({now, on(0), false, false});
    EXPECT_EQ(procedure.at(), 1U);
}

TEST_F(Procedure, RejectsATouchAtTheSamePlace) {
    touch(0);
    touch(0);
    EXPECT_EQ(procedure.at(), 1U);
    EXPECT_EQ(procedure.word(), TouchPrompt::SamePlace);
    touch(1);
    EXPECT_EQ(procedure.at(), 2U);
}

TEST_F(Procedure, BackRepeatsTheLastTouch) {
    touch(0);
    press(true);
    press(false); // leaves the rest
    EXPECT_EQ(procedure.stage(), CalibrationStage::Place);
    EXPECT_EQ(procedure.at(), 1U);
    press(false);
    EXPECT_EQ(procedure.at(), 0U);
    EXPECT_TRUE(procedure.touches().empty());
}

TEST_F(Procedure, VerdictSelectsTheNextStage) {
    const auto judged = [&](Verdict verdict, std::vector<std::size_t> repeat) {
        procedure.judge({verdict, {}, std::move(repeat), three_residuals, false});
    };
    for (std::size_t k = 0; k < 3; ++k) {
        touch(k);
    }
    judged(Verdict::Repeat, {2});
    EXPECT_EQ(procedure.stage(), CalibrationStage::Judged);
    press(true);
    EXPECT_EQ(procedure.stage(), CalibrationStage::Place);
    EXPECT_EQ(procedure.at(), 2U);
    touch(2);
    judged(Verdict::Usable, {});
    press(false); // repeats the one with the largest residual
    EXPECT_EQ(procedure.at(), 1U);
    touch(1);
    judged(Verdict::Good, {});
    press(true);
    EXPECT_EQ(procedure.stage(), CalibrationStage::Done);
    EXPECT_EQ(procedure.touches().size(), 3U);
    press(true);
    EXPECT_EQ(procedure.stage(), CalibrationStage::Done);
}

TEST_F(Procedure, RestartsAfterARefusal) {
    for (std::size_t k = 0; k < 3; ++k) {
        touch(k);
    }
    procedure.judge({});
    press(true);
    EXPECT_EQ(procedure.at(), 0U);
    EXPECT_TRUE(procedure.touches().empty());
}

TEST_F(Procedure, BackFromTheFirstCrossReturnsToBeginThenLeaves) {
    press(false);
    EXPECT_EQ(procedure.stage(), CalibrationStage::Begin);
    press(true);
    EXPECT_EQ(procedure.stage(), CalibrationStage::Place);
    press(false);
    press(false);
    EXPECT_EQ(procedure.stage(), CalibrationStage::Left);
    press(true);
    EXPECT_EQ(procedure.stage(), CalibrationStage::Left) << "it has ended";
}

TEST_F(Procedure, TimesOutWithoutPresses) {
    const auto wait = [&](Nanoseconds time) {
        now += time;
        procedure.step({now, on(0), false, false});
        return procedure.stage();
    };
    EXPECT_EQ(wait(TouchProcedure::to_go_on), CalibrationStage::Place);
    press(true);
    rest(on(0), TouchProcedure::rest + 2 * tick);
    EXPECT_EQ(procedure.at(), 1U);
    EXPECT_EQ(wait(TouchProcedure::to_go_on), CalibrationStage::Left) << "reports are no presses";

    TouchProcedure other(crosses());
    other.step({now, std::nullopt, false, false});
    other.step({now + TouchProcedure::to_begin, std::nullopt, false, false});
    EXPECT_EQ(other.stage(), CalibrationStage::Begin);
    other.step({now + TouchProcedure::to_begin + tick, std::nullopt, true, false});
    EXPECT_EQ(other.stage(), CalibrationStage::Place) << "a late press is one";
    other = TouchProcedure(crosses());
    other.step({now, std::nullopt, false, false});
    other.step({now + TouchProcedure::to_begin + tick, std::nullopt, false, false});
    EXPECT_EQ(other.stage(), CalibrationStage::Left);
}

TEST_F(Procedure, IgnoresNextIfCalibrationIsImpossible) {
    TouchProcedure cannot(crosses(), "the sensor's height is not known");
    cannot.step({now, std::nullopt, true, false});
    EXPECT_EQ(cannot.stage(), CalibrationStage::Begin);
    cannot.step({now, std::nullopt, false, true});
    EXPECT_EQ(cannot.stage(), CalibrationStage::Left);
}

/// A touch-up by the first two of three crosses.
class TouchUpProcedure : public Procedure {
protected:
    TouchUpProcedure() { procedure = TouchProcedure(TouchTask::TouchUp, crosses(), 2); }
    void touch_two() {
        press(true);
        touch(0);
        touch(1);
        ASSERT_EQ(procedure.stage(), CalibrationStage::Solve) << "the third is not asked for";
    }
};

TEST_F(TouchUpProcedure, BackFromBeginGoesOnToTheFullCalibration) {
    EXPECT_EQ(procedure.stage(), CalibrationStage::Begin);
    press(false);
    EXPECT_EQ(procedure.stage(), CalibrationStage::GoesOn);
    now += TouchProcedure::to_go_on + tick;
    procedure.step({now, std::nullopt, false, false});
    EXPECT_EQ(procedure.stage(), CalibrationStage::GoesOn) << "it has ended";
    procedure = TouchProcedure(TouchTask::TouchUp, crosses(), 2);
    procedure.step({now, std::nullopt, false, false});
    now += TouchProcedure::to_begin + tick;
    procedure.step({now, std::nullopt, false, false});
    EXPECT_EQ(procedure.stage(), CalibrationStage::Left) << "who does nothing leaves";
}

TEST_F(TouchUpProcedure, TooFewTouchesAddCrosses) {
    touch_two();
    procedure.judge({Verdict::Repeat, {}, {}, {three_residuals.begin(), three_residuals.begin() + 2}, false});
    EXPECT_TRUE(procedure.asks_for_more());
    EXPECT_EQ(procedure.count(), 2U);
    press(true);
    EXPECT_EQ(procedure.count(), 3U);
    EXPECT_EQ(procedure.at(), 2U);
    EXPECT_EQ(procedure.stage(), CalibrationStage::Place);
    touch(2);
    procedure.judge({Verdict::Repeat, {}, {}, three_residuals, false});
    EXPECT_FALSE(procedure.asks_for_more()) << "there are no others";
    press(true);
    EXPECT_EQ(procedure.at(), 1U) << "the farthest off again";
    touch(1);
    procedure.judge({Verdict::Good, {}, {}, three_residuals, false});
    press(true);
    EXPECT_EQ(procedure.stage(), CalibrationStage::Done);
}

TEST_F(Procedure, TooFewTouchesAddTwoCrossesAtATime) {
    procedure = TouchProcedure(TouchTask::Anew, crosses(), 1);
    press(true);
    for (const std::size_t count : {1U, 3U}) {
        EXPECT_EQ(procedure.count(), count);
        while (procedure.stage() == CalibrationStage::Place) {
            touch(procedure.at());
        }
        ASSERT_EQ(procedure.stage(), CalibrationStage::Solve);
        procedure.judge(
            {Verdict::Repeat, {}, {}, {three_residuals.begin(), three_residuals.begin() + 1}, false});
        EXPECT_EQ(procedure.asks_for_more(), count == 1);
        press(true);
    }
}

TEST_F(TouchUpProcedure, AfterARefusalNextGoesOnAndBackRestarts) {
    touch_two();
    procedure.judge({});
    press(false);
    EXPECT_EQ(procedure.stage(), CalibrationStage::Place);
    EXPECT_TRUE(procedure.touches().empty());
    touch(0);
    touch(1);
    procedure.judge({});
    press(true);
    EXPECT_EQ(procedure.stage(), CalibrationStage::GoesOn);
}

/// The whole procedure on a simulated table: crosses chosen for the described projector, touches on another
/// one.
TEST(ProcedureOnATable, EndsWithAnAccurateCalibration) {
    const simulators::SimulatedTable table = simulators::some_table(3);
    ChosenCrosses chosen;
    const std::vector<Cross> crosses = chosen.of(table, 9);
    TouchProcedure procedure(crosses);
    simulators::SeededNumbers numbers(4);
    MonotonicTime now = from_microseconds(0);
    procedure.step({now, std::nullopt, true, false});
    while (procedure.stage() != CalibrationStage::Solve) {
        procedure.step({now, std::nullopt, true, false});
        const Touch lies = simulators::simulated_touch(table, {procedure.cross(), 0.0}, {}, numbers);
        for (int k = 0; k < 60 && procedure.stage() == CalibrationStage::HoldStill; ++k) {
            now += tick;
            procedure.step({now, lies.tracker_from_sensor, false, false});
        }
        ASSERT_NE(procedure.word(), TouchPrompt::SamePlace);
    }
    const TouchCalibration judged = calibrate_touch(procedure.touches(), setup_for(table));
    ASSERT_TRUE(judged.table) << judged.reason.sentence;
    procedure.judge({judged.verdict, {}, judged.repeat, judged.residuals, false});
    procedure.step({now, std::nullopt, true, false});
    EXPECT_EQ(procedure.stage(), CalibrationStage::Done) << judged.reason.sentence;
    EXPECT_LT(simulators::registration_error(table, *judged.table, 0.12).mean_m, 1e-3);
}

} // namespace
} // namespace frustumscreen::calibration
