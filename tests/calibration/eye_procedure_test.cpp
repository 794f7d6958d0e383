// A person with a sensor on the head at the table, simulated report by report: from the first word to the
// eyes, with the errors on the way.
#include "app/programs/calibrate/table_pictures.h"
#include "tests/calibration/person_at_table.h"

#include <gtest/gtest.h>

#include <cstdio>
#include <set>

namespace frustumscreen::calibration {
namespace {

bool may_be_kept(Verdict verdict) {
    return verdict == Verdict::Good || verdict == Verdict::Usable;
}

/// Results of several people: how many end with an eye, and its error.
struct Outcome {
    int good = 0, kept = 0;
    double off_mm = 0.0; ///< root mean square
};

Outcome outcome_of(const char* name, int people, const Manner& manner) {
    Outcome outcome;
    for (int seed = 1; seed <= people; ++seed) {
        Live live(static_cast<std::uint64_t>(seed), manner);
        live.begin();
        live.sight_all();
        const EyeFit fit = live.fit();
        outcome.good += fit.verdict == Verdict::Good ? 1 : 0;
        outcome.kept += may_be_kept(fit.verdict) ? 1 : 0;
        if (fit.eyes) {
            const glm::dvec3 off = fit.eyes->middle_m - live.world.person.middle_m();
            outcome.off_mm += 1e6 * glm::dot(off, off) / people;
        }
    }
    outcome.off_mm = std::sqrt(outcome.off_mm);
    std::printf("%s: good %d, good or usable %d of %d; off by %.1f mm\n", name, outcome.good, outcome.kept,
                people, outcome.off_mm);
    return outcome;
}

TEST(EyeProcedure, RequestedPosturesDetermineTheEyes) {
    const Outcome usual = outcome_of("as asked", 40, {});
    EXPECT_GE(usual.kept, 38);
    EXPECT_LT(usual.off_mm, 8.0);
    Manner half;
    half.turn = 0.2;
    half.nod = 0.15;
    const Outcome less = outcome_of("half as far", 40, half);
    EXPECT_GE(less.kept, 20);
    Manner more = half;
    more.turn = 0.6;
    more.nod = 0.4;
    EXPECT_LT(outcome_of("farther", 40, more).off_mm, usual.off_mm);
}

TEST(EyeProcedure, AcceptsNoEyesIfThePropIsTurnedTenDegrees) {
    Manner manner; // touches leave that rotation open; the dot of light reveals less
    manner.kept_turn_rad = glm::radians(4.0);
    EXPECT_LT(outcome_of("prop turned by 4 degrees", 40, manner).off_mm, 15.0);
    manner.kept_turn_rad = glm::radians(10.0);
    EXPECT_EQ(outcome_of("prop turned by 10 degrees", 40, manner).kept, 0);
}

TEST(EyeProcedure, EachCrossIsLitVisibleAndWithinReach) {
    for (std::uint64_t seed = 1; seed <= 10; ++seed) {
        Live live(seed);
        live.begin();
        std::set<std::pair<int, int>> places;
        for (std::size_t k = 0; k < EyeProcedure::of_each; ++k) {
            live.sight();
            const SightCross& shown = live.procedure.cross();
            if (live.procedure.stage() != CalibrationStage::Place) {
                break;
            }
            live.aim();
            places.insert({std::lround(shown.pixel.x / 20.0), std::lround(shown.pixel.y / 20.0)});
            EXPECT_GT(shown.pixel.x, 40.0);
            EXPECT_LT(shown.pixel.x, 1880.0);
            EXPECT_GT(shown.pixel.y, 40.0);
            EXPECT_LT(shown.pixel.y, 1160.0);
            const double apart = glm::distance(glm::dvec2(shown.tip_m), glm::dvec2(shown.cross_m));
            EXPECT_GT(apart, 0.10);
            EXPECT_LT(apart, 0.25);
            const glm::dvec3 cross = simulators::true_light(live.world.truth, shown.pixel, 0.0);
            const glm::dvec3 tip = live.world.corner_near(shown.tip_m);
            for (double share = 0.0; share < 0.99; share += 0.01) {
                EXPECT_FALSE(live.world.is_in_prop(glm::mix(cross, tip, share)));
                EXPECT_FALSE(live.world.is_in_prop(glm::mix(live.eye_m, tip, share)));
                EXPECT_FALSE(live.world.is_in_prop(
                    glm::mix(cross, live.world.truth.table_from_projector.translation, share)));
            }
            EXPECT_LT(live.eye_m.y, -0.25) << "over the table's front edge or before it";
            EXPECT_GT(live.eye_m.z, 0.3);
            EXPECT_LT(live.eye_m.z, 0.8);
            EXPECT_LT(std::abs(live.eye_m.x), 0.35);
        }
        EXPECT_GE(places.size(), EyeProcedure::of_each - 1) << "another place each time";
    }
}

TEST(EyeProcedure, MeasuresTheEyesFromBeginToDone) {
    Live live(7);
    EXPECT_EQ(live.procedure.stage(), CalibrationStage::Begin);
    EXPECT_EQ(live.procedure.count(), 12U);
    live.begin();
    EXPECT_EQ(live.procedure.stage(), CalibrationStage::Shut);
    EXPECT_EQ(live.procedure.asked().eye, OpenEye::Left);
    EXPECT_EQ(programs::table_words(live.procedure).lines[0], "Shut your right eye");
    for (std::size_t k = 0; k < 12; ++k) {
        EXPECT_EQ(live.procedure.at(), k);
        EXPECT_EQ(live.procedure.asked().eye, k < 6 ? OpenEye::Left : OpenEye::Right);
        EXPECT_EQ(live.procedure.stage(), k % 6 == 0 ? CalibrationStage::Shut : CalibrationStage::Place);
        live.sight();
    }
    live.judge();
    ASSERT_TRUE(may_be_kept(live.procedure.judged()->verdict)) << live.procedure.judged()->reason.sentence;
    const glm::dvec3 off = live.procedure.judged()->eyes->middle_m - live.world.person.middle_m();
    EXPECT_LT(glm::length(off), 0.02);
    live.next();
    EXPECT_EQ(live.procedure.stage(), CalibrationStage::Done);
    live.wait(1.0);
    EXPECT_EQ(live.procedure.stage(), CalibrationStage::Done);
}

TEST(EyeProcedure, KeepsSightingsIfThePropIsPushed) {
    Live live(3);
    live.begin();
    for (int k = 0; k < 4; ++k) {
        live.sight();
    }
    const glm::dvec3 before = live.procedure.sights().front().tip_m;
    live.world.table_from_prop.translation += glm::dvec3(-0.02, 0.015, 0.0);
    live.world.table_from_prop.rotation = about(0.1, {0, 0, 1}) * live.world.table_from_prop.rotation;
    live.wait(0.2);
    EXPECT_EQ(live.procedure.stage(), CalibrationStage::Rest);
    EXPECT_EQ(live.procedure.word(), EyePrompt::PropMoved);
    EXPECT_NE(programs::table_words(live.procedure).lines.back().find("pushed"), std::string::npos);
    live.wait(1.2);
    ASSERT_EQ(live.procedure.stage(), CalibrationStage::Place);
    EXPECT_EQ(live.procedure.word(), EyePrompt::PropMoved) << "it is still to be read";
    EXPECT_EQ(live.procedure.at(), 4U);
    live.aim();
    live.next();
    live.wait(0.4);
    live.world.table_from_prop.translation.x += 0.01; // and once more, in the second
    live.wait(0.2);
    EXPECT_EQ(live.procedure.stage(), CalibrationStage::Rest);
    live.wait(1.2);
    live.sight_all();
    EXPECT_EQ(live.procedure.sights().front().tip_m, before) << "it keeps its own corner";
    live.judge();
    EXPECT_TRUE(may_be_kept(live.procedure.judged()->verdict)) << live.procedure.judged()->reason.sentence;
}

TEST(EyeProcedure, RepeatsAWrongSighting) {
    Live live(5);
    live.begin();
    for (int k = 0; k < 8; ++k) {
        live.cross_aside_m = k == 2 ? glm::dvec3(0.04, 0.0, 0.0) : glm::dvec3(0.0);
        live.sight();
    }
    live.sight_all();
    live.judge();
    ASSERT_EQ(live.procedure.judged()->verdict, Verdict::Repeat) << live.procedure.judged()->reason.sentence;
    ASSERT_EQ(live.procedure.judged()->repeat, (std::vector<std::size_t>{2}));
    EXPECT_FALSE(live.procedure.asks_for_more());
    live.next();
    live.wait(0.1);
    EXPECT_EQ(live.procedure.stage(), CalibrationStage::Shut) << "both eyes may be open since";
    EXPECT_EQ(live.procedure.at(), 2U);
    live.sight();
    live.judge();
    EXPECT_TRUE(may_be_kept(live.procedure.judged()->verdict)) << live.procedure.judged()->reason.sentence;
    live.back(); // repeats the one with the largest residual
    live.wait(0.1);
    const std::vector<double>& off = live.procedure.judged()->residuals_m;
    EXPECT_EQ(static_cast<std::ptrdiff_t>(live.procedure.at()),
              std::max_element(off.begin(), off.end()) - off.begin());
}

TEST(EyeProcedure, RefusesSightingsFromSimilarHeadPostures) {
    Manner alike;
    alike.turn = alike.nod = alike.spread = 0.0;
    Live stiff(6, alike);
    stiff.begin();
    stiff.sight();
    stiff.sight();
    EXPECT_EQ(stiff.procedure.word(), EyePrompt::SameHead);
    EXPECT_EQ(stiff.procedure.at(), 1U) << "it is not taken";
    alike.turn = 0.13; // accepted as different, but too little to determine an eye
    alike.nod = 0.1;
    Live live(6, alike);
    live.begin();
    live.sight_all();
    live.judge();
    ASSERT_EQ(live.procedure.judged()->verdict, Verdict::Refused);
    EXPECT_NE(
        programs::table_words(live.procedure).lines[1].find("turn the head, and move the chin up and down"),
        std::string::npos)
        << programs::table_words(live.procedure).lines[1];
    live.next();
    live.wait(0.1);
    EXPECT_EQ(live.procedure.at(), 0U);
    EXPECT_TRUE(live.procedure.sights().empty());
}

TEST(EyeProcedure, ReportsAPropOrHeadThatIsNotTracked) {
    Live nobody(8);
    nobody.sees_prop = false;
    nobody.begin();
    nobody.wait(1.0);
    EXPECT_EQ(nobody.procedure.stage(), CalibrationStage::Rest);
    EXPECT_EQ(nobody.procedure.word(), EyePrompt::PropNotSeen);
    Live live(8);
    live.sees_head = false;
    live.begin();
    live.wait(1.0);
    EXPECT_EQ(live.procedure.stage(), CalibrationStage::Rest);
    EXPECT_EQ(live.procedure.word(), EyePrompt::HeadNotSeen);
    live.sees_head = true;
    live.wait(0.1);
    EXPECT_EQ(live.procedure.stage(), CalibrationStage::Shut) << "the prop has rested meanwhile";
    live.sight();
    live.aim();
    live.next();
    live.wait(0.5);
    live.sees_head = false; // its cable came off
    live.wait(2.2);
    EXPECT_EQ(live.procedure.stage(), CalibrationStage::Place);
    EXPECT_EQ(live.procedure.word(), EyePrompt::HeadNotSeen);
    EXPECT_EQ(live.procedure.at(), 1U);
    live.sees_head = true;
    live.sees_prop = false;
    live.wait(2.2);
    live.next();
    live.wait(0.1);
    EXPECT_EQ(live.procedure.stage(), CalibrationStage::Place);
    EXPECT_EQ(live.procedure.word(), EyePrompt::PropNotSeen);
    live.sees_prop = true;
    live.sight();
    EXPECT_EQ(live.procedure.at(), 2U);
}

TEST(EyeProcedure, RestartsTheHoldIfTheHeadMoves) {
    Live live(9);
    live.begin();
    live.next(); // the right eye is shut
    live.aim();
    live.next();
    live.wait(0.7);
    live.table_from_sensor.translation.x += 0.02;
    live.wait(0.7);
    EXPECT_EQ(live.procedure.stage(), CalibrationStage::HoldStill);
    EXPECT_EQ(live.procedure.word(), EyePrompt::HeadMoved);
    live.back();
    EXPECT_EQ(live.procedure.stage(), CalibrationStage::Place);
    live.sight();
    EXPECT_EQ(live.procedure.at(), 1U);
}

TEST(EyeProcedure, BackRepeatsTheLastSightingAndLeavesAtTheBeginning) {
    Live live(10);
    live.begin();
    live.back();
    EXPECT_EQ(live.procedure.stage(), CalibrationStage::Begin);
    live.begin();
    for (int k = 0; k < 6; ++k) {
        live.sight();
    }
    EXPECT_EQ(live.procedure.stage(), CalibrationStage::Shut);
    live.back();
    EXPECT_EQ(live.procedure.at(), 5U);
    EXPECT_EQ(live.procedure.stage(), CalibrationStage::Place) << "that eye is still the open one";
    EXPECT_EQ(live.procedure.sights().size(), 5U);
    for (int k = 0; k < 6; ++k) {
        live.back();
    }
    EXPECT_EQ(live.procedure.stage(), CalibrationStage::Begin);
    live.back();
    EXPECT_EQ(live.procedure.stage(), CalibrationStage::Left);
}

TEST(EyeProcedure, TimesOutWithoutPresses) {
    Live live(11);
    live.wait(59.0);
    EXPECT_EQ(live.procedure.stage(), CalibrationStage::Begin);
    live.wait(2.0);
    EXPECT_EQ(live.procedure.stage(), CalibrationStage::Left);
    Live later(11);
    later.begin();
    later.now += EyeProcedure::to_go_on;
    later.step();
    EXPECT_EQ(later.procedure.stage(), CalibrationStage::Left);
}

TEST(EyeProcedure, ReportsAnUnsuitablePlaceOrSetUp) {
    Live live(12);
    live.world.table_from_prop.translation.z = 0.03;
    live.begin();
    EXPECT_EQ(live.procedure.word(), EyePrompt::OffTable);
    live.world.table_from_prop.translation = {0.0, 0.3, 0.0}; // nothing lights the table behind it
    live.wait(1.5);
    EXPECT_EQ(live.procedure.stage(), CalibrationStage::Rest);
    EXPECT_EQ(live.procedure.word(), EyePrompt::NoRoom);
    live.world.table_from_prop.translation = {0.1, -0.05, 0.0};
    live.wait(0.1);
    EXPECT_EQ(live.procedure.word(), EyePrompt::PropMoves);
    live.wait(1.2);
    EXPECT_EQ(live.procedure.stage(), CalibrationStage::Shut);
    const EyeProcedure cannot(live.world.scene(), live.world.registration(), "no calibration is kept");
    EXPECT_EQ(programs::table_words(cannot).lines[1], "No calibration is kept.");
    SightScene small = live.world.scene();
    small.table_from_projector.translation.z = 0.7; // a picture of 37 x 23 cm
    EXPECT_NE(programs::table_words(EyeProcedure(small, {})).lines[1].find("too small for crosses"),
              std::string::npos);
}

TEST(EyeProcedure, AsksForMoreSightingsIfTooFew) {
    Live live(13);
    live.begin();
    live.sight_all();
    EyeFit few = live.fit();
    few.verdict = Verdict::Repeat;
    few.repeat.clear();
    live.procedure.judge(few);
    EXPECT_TRUE(live.procedure.asks_for_more());
    live.next();
    live.wait(0.1);
    EXPECT_EQ(live.procedure.count(), 16U);
    EXPECT_EQ(live.procedure.at(), 12U);
    EXPECT_EQ(live.procedure.asked().eye, OpenEye::Left);
    live.sight_all();
    EXPECT_EQ(live.procedure.sights().size(), 16U);
    live.judge();
    EXPECT_TRUE(may_be_kept(live.procedure.judged()->verdict));
}

} // namespace
} // namespace frustumscreen::calibration
