// Guidance for visitors: signs that never lie on the prop, then words, then speech; and silence.
#include "app/bench/truth/seeded_situations.h"
#include "exhibits.h"
#include "tests/render/counted_new.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>

namespace frustumscreen::exhibit {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

ExhibitPlace guided_place() {
    ExhibitPlace place = sample::shipped_place();
    place.words = {{"de", {{"slide_left", {{0.1, 0.02}}}, {"slide_right", {{0.1, 0.02}}}}},
                   {"en", {{"slide_left", {{0.1, 0.02}}}, {"slide_right", {{0.1, 0.02}}}}}};
    return place;
}

bool on_the_left(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& p) {
    return (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x) >= -1e-9;
}

bool inside(std::span<const glm::dvec2> polygon, const glm::dvec2& p) {
    for (std::size_t k = 0; k < polygon.size(); ++k) {
        if (!on_the_left(polygon[k], polygon[(k + 1) % polygon.size()], p)) {
            return false;
        }
    }
    return true;
}

/// A point of a sign's picture, by its fractions of width and height.
glm::dvec2 point_of(const PlacedSign& sign, double u, double v) {
    const auto& c = sign.corners_m;
    return glm::mix(glm::mix(c[0], c[1], u), glm::mix(c[3], c[2], u), v);
}

/// The sign's light meets the table and not the prop: traced ray by ray.
void expect_beside_prop(const PlacedSign& sign, const ExhibitPlace& place,
                        const geometry::RigidTransform& table_from_prop, const std::string& where) {
    const geometry::RigidTransform prop_from_table = table_from_prop.inverse();
    const glm::dvec3 lens = prop_from_table.point(place.lens_m);
    for (const double u : {0.0, 0.25, 0.5, 0.75, 1.0}) {
        for (const double v : {0.0, 0.5, 1.0}) {
            const glm::dvec2 point = point_of(sign, u, v);
            EXPECT_TRUE(inside(place.picture_m, point)) << where;
            geometry::PropHit hit;
            const glm::dvec3 ray = prop_from_table.point({point, 0.0}) - lens;
            EXPECT_FALSE(geometry::enter(place.prop, lens, ray, hit) && hit.t < 1.0 - 1e-6) << where;
        }
    }
}

TEST(Signs, LieInThePictureAndNeverOnTheProp) {
    const ExhibitPlace place = guided_place();
    const guidance::FaceReader reader(*place.guidance);
    bench::Seeded seeded(21);
    std::map<Sign, int> shown;
    int advised = 0;
    for (int k = 0; k < 1500; ++k) {
        guidance::Guidance guidance;
        guidance.tracked_state = bench::seeded_situation(*place.guidance, seeded);
        const std::optional<guidance::Advice> advice = guidance::advise(reader, guidance.tracked_state);
        const auto shadow =
            typography::hidden_by_prop(place.prop, guidance.tracked_state.table_from_prop, place.lens_m);
        if (!advice || !shadow) {
            continue;
        }
        ++advised;
        guidance.stage = guidance::GuidanceStage::Picture;
        guidance.move = advice->move;
        const MonotonicTime now{milliseconds(static_cast<int>(seeded.between(0.0, 5000.0)))};
        const auto sign = place_sign(guidance, now, *shadow, place.picture_m, k % 4);
        if (!sign) {
            continue;
        }
        ++shown[sign->sign];
        expect_beside_prop(*sign, place, guidance.tracked_state.table_from_prop,
                           "situation " + std::to_string(k));
    }
    EXPECT_GT(shown[Sign::Arrow], 100);
    EXPECT_GT(shown[Sign::Stand], 100);
    EXPECT_GT(shown[Sign::Lower], 100);
    int all = 0;
    for (const auto& [sign, count] : shown) {
        all += count;
    }
    EXPECT_GT(all, advised * 9 / 10); // there is no space if the prop fills the picture
}

TEST(Signs, ArrowPointsAlongTheMove) {
    const ExhibitPlace place = guided_place();
    guidance::Guidance guidance;
    guidance.stage = guidance::GuidanceStage::Picture;
    guidance.tracked_state.eye_m = {0.0, -0.6, 0.5};
    int pointed = 0;
    for (int k = 0; k < 16; ++k) {
        const double azimuth = k * std::numbers::pi / 8.0;
        guidance.move = {guidance::Action::Slide, {0.1 * std::cos(azimuth), 0.1 * std::sin(azimuth), 0.0}};
        const auto shadow = typography::hidden_by_prop(place.prop, {}, place.lens_m);
        const auto sign = place_sign(guidance, MonotonicTime(seconds(1)), *shadow, place.picture_m, 0);
        if (!sign) {
            continue; // the shipped prop leaves little space above and below it
        }
        const glm::dvec2 along = point_of(*sign, 1.0, 0.5) - point_of(*sign, 0.0, 0.5);
        EXPECT_NEAR(std::remainder(std::atan2(along.y, along.x) - azimuth, 2.0 * std::numbers::pi), 0.0,
                    1e-9);
        ++pointed;
    }
    EXPECT_GE(pointed, 8);
}

/// A turn's arrowhead is at the end that it turns to: counter-clockwise about the prop, seen from above.
TEST(Signs, ArcPointsInTheDirectionOfTheTurn) {
    ExhibitPlace place = guided_place();
    place.picture_m = {{-1.0, -1.0}, {1.0, -1.0}, {1.0, 1.0}, {-1.0, 1.0}};
    for (const double turn : {0.5, -0.5}) {
        guidance::Guidance guidance;
        guidance.stage = guidance::GuidanceStage::Picture;
        guidance.move = {guidance::Action::Turn, {}, turn};
        guidance.tracked_state.eye_m = {0.0, -0.6, 0.5};
        const auto shadow = typography::hidden_by_prop(place.prop, {}, place.lens_m);
        const auto sign = place_sign(guidance, MonotonicTime(seconds(1)), *shadow, place.picture_m, 0);
        ASSERT_TRUE(sign);
        const glm::dvec2 tail = point_of(*sign, 0.0, 0.5);
        const glm::dvec2 head = point_of(*sign, 1.0, 0.5);
        EXPECT_GT(turn * (tail.x * head.y - tail.y * head.x), 0.0);
    }
    // The picture itself: more ink at the head's end.
    const image::Image<std::uint8_t> arc = sign_picture(Sign::Turn, 2000.0);
    long left = 0;
    long right = 0;
    for (int y = 0; y < arc.height; ++y) {
        for (int x = 0; x < arc.width; ++x) {
            (x < arc.width / 2 ? left : right) += arc.at(x, y);
        }
    }
    EXPECT_GT(right, left * 11 / 10);
}

/// The picture of the table is 58 cm wide, and the shadow of a cube of 12 cm at most 20 cm: beside it there is space.
TEST(Signs, ArcFitsBesideALargeCubeAtAnyYaw) {
    settings::Settings settings = bench::cube_in_hand();
    settings.prop = settings::cube_settings(0.12);
    ExhibitPlace place;
    place.prop = settings::make_prop(settings.prop);
    place.lens_m = settings.projector.table_from_projector.translation;
    place.picture_m = settings::picture_on_table(settings, 0.0);
    int fits = 0;
    for (const double yaw_deg : {0.0, 20.0, 45.0, 70.0}) {
        for (int k = 0; k < 15 * 9; ++k) {
            guidance::Guidance guidance;
            guidance.stage = guidance::GuidanceStage::Picture;
            guidance.move = {guidance::Action::Turn, {}, k % 2 == 0 ? 0.5 : -0.5};
            geometry::RigidTransform& pose = guidance.tracked_state.table_from_prop;
            pose.rotation = glm::angleAxis(yaw_deg * std::numbers::pi / 180.0, glm::dvec3(0.0, 0.0, 1.0));
            pose.translation = {0.04 * (k % 15 - 7), 0.04 * (k / 15 - 4), 0.0};
            const auto shadow = typography::hidden_by_prop(place.prop, pose, place.lens_m);
            ASSERT_TRUE(shadow);
            const auto corners = shadow->corners();
            if (!std::all_of(corners.begin(), corners.end(),
                             [&](const glm::dvec2& corner) { return inside(place.picture_m, corner); })) {
                continue;
            }
            ++fits;
            const std::string where = fmt::format("{} degrees at {:.2f}, {:.2f}, side {}", yaw_deg,
                                                  pose.translation.x, pose.translation.y, k % 4);
            glm::dvec2 lowest(1.0), highest(-1.0);
            for (int tenth = 0; tenth < 18; ++tenth) { // a swing takes 1.8 s
                const auto sign = place_sign(guidance, MonotonicTime(milliseconds(100 * tenth)), *shadow,
                                             place.picture_m, k % 4);
                ASSERT_TRUE(sign) << where;
                expect_beside_prop(*sign, place, pose, where);
                lowest = glm::min(lowest, point_of(*sign, 0.5, 0.5));
                highest = glm::max(highest, point_of(*sign, 0.5, 0.5));
            }
            EXPECT_LT(glm::distance(lowest, highest), 0.04) << where << ": it stays on one side";
        }
    }
    EXPECT_GT(fits, 4 * 20);
}

class GuidedExhibit : public ::testing::Test {
protected:
    Presentation at(Nanoseconds time, double x) {
        Presentation presentation;
        for (; time_ <= time; time_ += milliseconds(20)) {
            const MonotonicTime now = sample::start + time_;
            tracking::TrackedState tracked_state = sample::tracked_state(now);
            tracked_state.head_known = true;
            tracked_state.table_from_prop.translation = {x, 0.0, 0.0};
            presentation = exhibit_.step(now, {}, tracked_state);
            said_ += presentation.says ? 1 : 0;
            silences_ += presentation.falls_silent ? 1 : 0;
        }
        return presentation;
    }
    Exhibit exhibit_{Catalogue(1, {{"en"}, {{{0.2, 0.05}}}}), guided_place(), "en", sample::start};
    Nanoseconds time_{0};
    int said_ = 0;
    int silences_ = 0;
};

TEST_F(GuidedExhibit, ShowsASignThenWordsThenSpeaks) {
    at(seconds(1), 0.0);
    EXPECT_FALSE(at(milliseconds(1300), 0.3).sign);
    const Presentation sign = at(seconds(2), 0.3);
    ASSERT_TRUE(sign.sign);
    EXPECT_FALSE(sign.advice);
    const Presentation words = at(milliseconds(4500), 0.3);
    ASSERT_TRUE(words.advice);
    EXPECT_EQ(words.advice->word, (WordIndex{1, 0})); // en, slide_left
    EXPECT_EQ(said_, 0);
    // The artifact's caption fades meanwhile.
    EXPECT_TRUE(!words.caption || words.caption->brightness < 0.01);
    at(seconds(7), 0.3);
    EXPECT_EQ(said_, 1);
    const Presentation restored = at(seconds(8), 0.0);
    EXPECT_FALSE(restored.sign || restored.advice);
    EXPECT_TRUE(restored.caption);
    EXPECT_EQ(silences_, 1);
}

TEST_F(GuidedExhibit, ShowsNoSignWithoutAVisitor) {
    at(seconds(1), 0.0);
    EXPECT_TRUE(at(seconds(20), 0.3).sign);
    EXPECT_FALSE(at(seconds(1) + Presence::stays + seconds(1), 0.3).sign); // nothing has moved since
    EXPECT_TRUE(at(seconds(40), 0.31).sign);
}

TEST_F(GuidedExhibit, DoesNotInterruptSpeech) {
    exhibit_.hear(true);
    at(seconds(1), 0.0);
    at(seconds(25), 0.3);
    EXPECT_EQ(said_, 0);
}

TEST_F(GuidedExhibit, GuidesWithoutAllocating) {
    at(seconds(1), 0.0);
    if (!synthetic::allocations_are_counted) {
        GTEST_SKIP() << "a sanitizer allocates by itself";
    }
    const long before = synthetic::allocations_so_far();
    at(seconds(12), 0.3);
    at(seconds(14), -0.25);
    at(seconds(15), 0.0);
    EXPECT_EQ(synthetic::allocations_so_far(), before);
}

/// A tracker's noise at rest does not count as a visitor.
TEST(PresenceTest, DetectsAMovementOrAPress) {
    Presence presence;
    bench::Seeded seeded(4);
    tracking::TrackedState tracked_state = sample::tracked_state(sample::start);
    for (int k = 0; k < 2000; ++k) {
        tracked_state.table_from_prop.translation =
            1e-3 * glm::dvec3(seeded.between(-1, 1), seeded.between(-1, 1), seeded.between(-1, 1));
        EXPECT_FALSE(presence.update(sample::start + milliseconds(20 * k), tracked_state, false));
    }
    const MonotonicTime pressed = sample::start + seconds(41);
    EXPECT_TRUE(presence.update(pressed, tracked_state, true));
    EXPECT_TRUE(presence.update(pressed + Presence::stays - milliseconds(1), tracked_state, false));
    EXPECT_FALSE(presence.update(pressed + Presence::stays, tracked_state, false));
    tracked_state.table_from_prop.translation.x = 0.02;
    EXPECT_TRUE(presence.update(pressed + seconds(60), tracked_state, false));
}

} // namespace
} // namespace frustumscreen::exhibit
