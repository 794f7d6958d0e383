// The pictures and words while the eyes are measured: every key has its sentence, and no words cover the
// cross or leave the picture.
#include "app/programs/calibrate/table_pictures.h"
#include "tests/calibration/expect_sentences.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <set>

namespace frustumscreen::calibration {
namespace {

constexpr Nanoseconds tick = std::chrono::milliseconds(20);

SightScene shipped_scene(int width, int height) {
    return {{width, height, 1.875 * width, 1.875 * width, 0.5 * width, 0.5 * height},
            {glm::dquat(0.0, 1.0, 0.0, 0.0), {0.0, 0.0, 1.5}},
            geometry::make_frustum({0.30, 0.08, 0.155}),
            {0.0, -0.55, 0.5}};
}

/// A person who follows all instructions; `look` sees every step in between.
class Person {
public:
    using Look = std::function<void(const EyeProcedure&)>;
    Person(const SightScene& scene, const geometry::RigidTransform& prop, Look look)
        : procedure(scene, {}), prop(prop), look_(std::move(look)) {
        head.translation = scene.usual_eye_m;
        look_(procedure);
    }
    void step(bool next = false) {
        now += tick;
        procedure.step({now, prop, next, false, head});
        look_(procedure);
    }
    void go_to_solve() {
        while (procedure.stage() != CalibrationStage::Solve) {
            const bool waits = procedure.stage() == CalibrationStage::Begin ||
                               procedure.stage() == CalibrationStage::Shut ||
                               procedure.stage() == CalibrationStage::Place;
            head.rotation =
                glm::angleAxis(0.3 * static_cast<double>(procedure.at() % 3), glm::dvec3(1, 0, 0));
            step(waits);
        }
    }
    void judge(Verdict verdict, std::vector<std::size_t> repeat = {}) {
        EyeFit fit;
        fit.verdict = verdict;
        fit.reason.sentence =
            "the eye's place puts about 1.1 mm on the picture; with more sightings it would be good";
        fit.repeat = std::move(repeat);
        if (verdict != Verdict::Refused) {
            fit.eyes.emplace();
        }
        procedure.judge(fit);
        look_(procedure);
    }

    EyeProcedure procedure;
    geometry::RigidTransform prop, head;
    MonotonicTime now = from_microseconds(1'000'000);

private:
    Look look_;
};

/// Direction from the cross to the corner of a sighting in the shipped scene.
glm::dvec3 line_of(const ReportedSight& sight) {
    const glm::dvec3 cross((sight.pixel.x - 320.0) / 800.0, (200.0 - sight.pixel.y) / 800.0, 0.0);
    return glm::normalize(sight.tip_m - cross);
}

TEST(EyePicture, EveryMessageKeyHasASentence) {
    std::set<std::string> said;
    const auto listen = [&](const EyeProcedure& procedure) {
        said.insert(std::string(programs::table_words(procedure).key));
    };
    const SightScene scene = shipped_scene(640, 400);
    for (const Verdict verdict : {Verdict::Usable, Verdict::Repeat, Verdict::Refused}) {
        Person person(scene, first_place(scene), listen);
        person.go_to_solve();
        person.judge(verdict);
        person.step(true);
    }
    Person doubtful(scene, first_place(scene), listen);
    doubtful.go_to_solve();
    doubtful.judge(Verdict::Repeat, {3});
    // The errors.
    Person person(scene, {{1.0, 0.0, 0.0, 0.0}, {0.1, -0.05, 0.05}}, listen);
    const auto wait = [&](Nanoseconds time) {
        for (const MonotonicTime end = person.now + time; person.now < end;) {
            person.step();
        }
    };
    person.step(true);
    wait(std::chrono::milliseconds(1500)); // it does not stand on the table
    person.prop.translation = {0.1, 0.3, 0.0};
    wait(std::chrono::milliseconds(1500)); // no room
    person.prop = first_place(scene);
    wait(std::chrono::milliseconds(1500));
    person.step(true); // the eye is shut
    person.step(true);
    wait(std::chrono::milliseconds(500));
    person.head.translation.x += 0.05; // the head moved
    wait(std::chrono::milliseconds(1500));
    const glm::dvec3 before = line_of(person.procedure.sights()[0]);
    const glm::dvec3 after =
        glm::normalize(person.procedure.cross().tip_m - person.procedure.cross().cross_m);
    const double angle = std::acos(glm::dot(before, after));
    person.head.rotation = glm::angleAxis(angle, glm::normalize(glm::cross(before, after)));
    person.step(true);
    wait(std::chrono::milliseconds(1500)); // it looks out of the head as before
    person.prop.translation.x += 0.02;     // the prop is pushed
    wait(std::chrono::milliseconds(500));
    person.procedure.step({person.now + std::chrono::seconds(3), person.prop});
    listen(person.procedure); // no head
    person.procedure.step({person.now + std::chrono::seconds(6), std::nullopt, false, false, person.head});
    listen(person.procedure); // no prop
    person.procedure.step({person.now + std::chrono::minutes(20)});
    listen(person.procedure);
    EXPECT_EQ(said.size(), 24U) << ::testing::PrintToString(said);
    expect_sentences(said);
    EXPECT_EQ(programs::table_words(EyeProcedure(scene, {}, "it cannot be done")).key, "")
        << "there is none for every reason";
}

bool is_lit(const glm::u8vec4& colour) {
    return std::max({colour.r, colour.g, colour.b}) > 40;
}

/// The places where light is expected besides the words: the cross's arms, and the prop's top.
bool is_of_cross(const EyeProcedure& procedure, const glm::dvec2& pixel, double px_per_m) {
    const glm::dvec2 from = glm::abs(pixel - procedure.cross().pixel);
    const double thick = 0.012 * px_per_m;
    return std::fmax(from.x, from.y) < 0.03 * px_per_m && std::fmin(from.x, from.y) < thick;
}

TEST(EyePicture, WordsOverlapNeitherCrossNorProp) {
    const Result<typography::Typesetter> typesetter = typography::Typesetter::open();
    ASSERT_TRUE(typesetter);
    constexpr int width = 960, height = 600;
    constexpr double px_per_m = 1.875 * width / 1.5;
    const SightScene scene = shipped_scene(width, height);
    for (const glm::dvec3 place : {glm::dvec3(0.104, -0.05, 0.0), glm::dvec3(0.0),
                                   glm::dvec3(-0.12, -0.05, 0.4), glm::dvec3(0.2, 0.0, 0.8)}) {
        const geometry::RigidTransform prop{glm::angleAxis(place.z, glm::dvec3(0, 0, 1)),
                                            {place.x, place.y, 0.0}};
        std::optional<std::size_t> last;
        const auto look = [&](const EyeProcedure& procedure) {
            if (procedure.stage() != CalibrationStage::Place || last == procedure.at()) {
                return;
            }
            last = procedure.at();
            const image::Image8 picture = programs::table_picture(procedure, {.typesetter = *typesetter});
            const WordsBox& box = procedure.words();
            std::size_t of_words = 0, of_cross = 0, of_tip = 0, elsewhere = 0;
            for (int v = 0; v < height; ++v) {
                for (int u = 0; u < width; ++u) {
                    if (!is_lit(picture.at(u, v))) {
                        continue;
                    }
                    const glm::dvec2 pixel(u + 0.5, v + 0.5);
                    const bool in_box = glm::all(glm::greaterThan(pixel, box.low - 2.0)) &&
                                        glm::all(glm::lessThan(pixel, box.high + 2.0));
                    // The prop's top, lit from 1.5 m: 15.5 cm nearer.
                    const glm::dvec3 on_top((pixel.x - 0.5 * width) / px_per_m * 1.345 / 1.5,
                                            (0.5 * height - pixel.y) / px_per_m * 1.345 / 1.5, 0.155);
                    const glm::dvec3 in_prop = prop.inverse().point(on_top);
                    const bool on_prop = std::fmax(std::abs(in_prop.x), std::abs(in_prop.y)) < 0.042;
                    const bool is_cross = is_of_cross(procedure, pixel, px_per_m);
                    EXPECT_LE(int{in_box} + int{on_prop} + int{is_cross}, 1) << u << ", " << v;
                    of_words += in_box ? 1U : 0U;
                    of_tip += on_prop ? 1U : 0U;
                    of_cross += is_cross ? 1U : 0U;
                    elsewhere += in_box || on_prop || is_cross ? 0U : 1U;
                }
            }
            EXPECT_GT(of_words, 1000U);
            EXPECT_GT(of_cross, 60U);
            EXPECT_GT(of_tip, 30U);
            EXPECT_EQ(elsewhere, 0U) << place.x << ": sighting " << procedure.at();
            EXPECT_GT(procedure.cross().pixel.y, 0.0);
        };
        Person person(scene, prop, look);
        person.go_to_solve();
        EXPECT_EQ(last, 11U);
    }
}

} // namespace
} // namespace frustumscreen::calibration
