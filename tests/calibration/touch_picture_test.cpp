// The pictures and words during a calibration by touch.
#include "app/programs/calibrate/table_pictures.h"
#include "tests/calibration/expect_sentences.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

namespace frustumscreen::calibration {
namespace {

constexpr int width = 640;
constexpr int height = 400;
constexpr Nanoseconds tick = std::chrono::milliseconds(20);

geometry::Pinhole projector() {
    return {width, height, 1.875 * width, 1.875 * width, 0.5 * width, 0.5 * height};
}

/// Runs from the first cross to a verdict; calls `look` whenever the picture changes.
void walk(TouchProcedure procedure, TouchJudgement judged, const auto& look) {
    MonotonicTime now{};
    look(procedure);
    procedure.step({now, std::nullopt, true, false});
    while (procedure.stage() == CalibrationStage::Place) {
        look(procedure);
        const double place_m = 0.1 * static_cast<double>(procedure.at());
        procedure.step({now, std::nullopt, true, false});
        look(procedure);
        while (procedure.stage() == CalibrationStage::HoldStill) {
            now += tick;
            procedure.step(
                {now, geometry::RigidTransform{{1.0, 0.0, 0.0, 0.0}, {place_m, 0.0, 0.1}}, false, false});
        }
    }
    look(procedure);
    procedure.judge(std::move(judged));
    look(procedure);
    procedure.step({now, std::nullopt, true, false});
    look(procedure);
}

TEST(TouchPicture, EveryMessageKeyHasASentence) {
    std::set<std::string> said;
    const auto listen = [&](const TouchProcedure& procedure) {
        said.insert(std::string(programs::table_words(procedure).key));
    };
    const std::vector<Cross> crosses{{{100, 100}, 0.0, 0.0}, {{500, 100}, 0.0, 0.0}, {{300, 300}, 0.08, 1.5}};
    for (const Verdict verdict : {Verdict::Good, Verdict::Usable, Verdict::Repeat, Verdict::Refused}) {
        walk(TouchProcedure(crosses), {verdict, {}, {}, {}, false}, listen);
        walk(TouchProcedure(TouchTask::TouchUp, crosses, 2), {verdict, {}, {}, {}, false}, listen);
    }
    walk(TouchProcedure(TouchTask::TouchUp, crosses, 2), {Verdict::Good, {}, {}, {}, true}, listen);
    EXPECT_EQ(said.size(), 16U);
    expect_sentences(said);
    EXPECT_EQ(programs::table_words(TouchProcedure(crosses, "it cannot be done")).key, "")
        << "there is none for every reason";
}

/// Number of orange pixels outside the prop, which covers its own square and more as seen from above.
std::size_t arrow_pixels(const image::Image8& picture, const Cross& cross, double prop_px) {
    std::size_t count = 0;
    for (int v = 0; v < picture.height; ++v) {
        for (int u = 0; u < picture.width; ++u) {
            const glm::u8vec4& colour = picture.at(u, v);
            const glm::dvec2 from = glm::abs(glm::dvec2(u + 0.5, v + 0.5) - cross.pixel);
            const bool is_covered = std::fmax(from.x, from.y) < 0.5 * prop_px;
            count += !is_covered && colour.r > 200 && colour.b < 150 ? 1U : 0U;
        }
    }
    return count;
}

TEST(TouchPicture, ArrowForThePropsFrontIsVisibleBesideIt) {
    const Result<typography::Typesetter> typesetter = typography::Typesetter::open();
    ASSERT_TRUE(typesetter);
    constexpr double prop_px = 0.3 / 1.5 * 1.875 * width;
    for (const int count : {6, 9, 15, -15}) {
        CrossSetup setup;
        setup.count = std::abs(count);
        setup.reach_m = count < 0 ? std::optional(reach_of({0.8, 0.5}, 0.3)) : std::nullopt;
        const auto look = [&](const TouchProcedure& procedure) {
            if (procedure.stage() == CalibrationStage::Place) {
                const image::Image8 picture = programs::table_picture(
                    procedure,
                    {.width = width, .height = height, .prop_px = prop_px, .typesetter = *typesetter});
                EXPECT_GT(arrow_pixels(picture, procedure.cross(), prop_px), 30U)
                    << procedure.at() << " of " << count;
            }
        };
        walk(TouchProcedure(choose_crosses(rough_model(projector(), 1.5, 0.08), setup)),
             {Verdict::Good, {}, {}, {}, false}, look);
    }
}

/// White pixels that no arm explains, inside the prop's square or outside it.
std::size_t word_pixels(const image::Image8& picture, const Cross& cross, double prop_px, bool inside) {
    constexpr double line_px = 4.0;
    std::size_t count = 0;
    for (int v = 0; v < picture.height; ++v) {
        for (int u = 0; u < picture.width; ++u) {
            const glm::u8vec4& colour = picture.at(u, v);
            const glm::dvec2 from = glm::abs(glm::dvec2(u + 0.5, v + 0.5) - cross.pixel);
            const bool is_arm = std::fmin(from.x, from.y) < line_px;
            const bool is_circle = std::fmax(from.x, from.y) < 2.0 * picture.width / 160.0;
            const bool is_inside = std::fmax(from.x, from.y) < 0.5 * prop_px - line_px;
            count += colour.b > 200 && !is_arm && !is_circle && is_inside == inside ? 1U : 0U;
        }
    }
    return count;
}

/// The prop hides none of them, wherever it stands on the shipped table.
TEST(TouchPicture, WordsAvoidTheProp) {
    const Result<typography::Typesetter> typesetter = typography::Typesetter::open();
    ASSERT_TRUE(typesetter);
    constexpr double prop_px = 0.3 / 1.5 * 1.875 * width;
    CrossSetup setup;
    setup.count = 15;
    setup.reach_m = reach_of({0.8, 0.5}, 0.3);
    int looked_at = 0;
    const auto look = [&](const TouchProcedure& procedure) {
        if (procedure.stage() == CalibrationStage::Place) {
            const image::Image8 picture = programs::table_picture(
                procedure, {.width = width, .height = height, .prop_px = prop_px, .typesetter = *typesetter});
            EXPECT_EQ(word_pixels(picture, procedure.cross(), prop_px, true), 0U) << procedure.at();
            EXPECT_GT(word_pixels(picture, procedure.cross(), prop_px, false), 500U) << procedure.at();
            ++looked_at;
        }
    };
    walk(TouchProcedure(choose_crosses(rough_model(projector(), 1.5, 0.08), setup)),
         {Verdict::Good, {}, {}, {}, false}, look);
    EXPECT_GE(looked_at, 15);
}

TEST(JudgedWords, ATouchUpReportsWhatMovedAndHowFar) {
    TouchUp found;
    found.verdict = Verdict::Good;
    found.moved = Moved::Projector;
    found.table.emplace();
    found.off_m = 0.0124;
    found.uncertainty.mean_m = 5e-4;
    EXPECT_EQ(programs::judgement_of(found).told,
              (std::vector<std::string>{"The projector moved.",
                                        "The picture was 12 mm off. Once this is kept it is "
                                        "right again, to about 0.5 mm."}));
    found.verdict = Verdict::Repeat;
    found.moved = Moved::Either;
    EXPECT_EQ(programs::judgement_of(found).told,
              (std::vector<std::string>{"The projector moved, or the tracker's source.",
                                        "The picture was 12 mm off. These touches are too few "
                                        "to check each other."}));
    found.moved = Moved::Nothing;
    found.reason.sentence = "the kept calibration holds";
    EXPECT_TRUE(programs::judgement_of(found).nothing_moved);
    EXPECT_EQ(programs::judgement_of(found).told,
              (std::vector<std::string>{"Nothing has moved.", "The kept calibration holds."}));
    const TouchJudgement refused = programs::judgement_of(TouchUp{});
    EXPECT_EQ(refused.verdict, Verdict::Refused);
    EXPECT_FALSE(refused.nothing_moved);
}

} // namespace
} // namespace frustumscreen::calibration
