// Guidance and the pictures on the table: choosing a picture needs no advice, and words lie beside pictures.

#include "app/settings/lit_zone.h"
#include "app/settings/whole_zone.h"
#include "tests/exhibit/exhibits.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <utility>

namespace frustumscreen::exhibit {
namespace {

using sample::start;
using std::chrono::milliseconds;

struct Visit {
    settings::Settings shipped;
    ExhibitPlace place = sample::shipped_place();
    std::optional<Exhibit> exhibit;
    MonotonicTime now = start;
    tracking::TrackedState tracked_state = sample::tracked_state(start);
    Presentation shown;

    explicit Visit(bool pictures, std::vector<glm::dvec3> hull = {}) {
        place.table_pictures = pictures;
        place.zone = ZoneFrame(settings::lit_rectangle(shipped), 0.15, {0.8, 0.5});
        place.words = {
            sample::words_of("en", {"slide_left", "slide_right", "slide_nearer", "slide_farther",
                                    "slide_left_a_little", "slide_right_a_little", "slide_nearer_a_little",
                                    "slide_farther_a_little", "turn", "turn_left", "turn_right"})};
        CatalogueEntry entry{{"en"}, {{{0.2, 0.05}, {0.1, 0.1}}}, {}};
        entry.hull = std::move(hull);
        exhibit.emplace(Catalogue(6, entry), place, "en", start);
    }
    void step() {
        now += milliseconds(16);
        tracked_state.time = now;
        shown = exhibit->step(now, {}, tracked_state);
    }
    /// Slides there in half a second, or in `steps` steps. Returns the number of steps with a sign.
    int slide_to(const glm::dvec2& goal, int steps = 30) {
        const glm::dvec3 from = tracked_state.table_from_prop.translation;
        int signs = 0;
        for (int k = 1; k <= steps; ++k) {
            tracked_state.table_from_prop.translation =
                glm::mix(from, glm::dvec3(goal, 0.0), static_cast<double>(k) / steps);
            step();
            signs += shown.sign || shown.advice || shown.says ? 1 : 0;
        }
        return signs;
    }
    /// Number of steps in `time` with a sign.
    int signs_in(milliseconds time) {
        int signs = 0;
        for (milliseconds each{0}; each < time; each += milliseconds(16)) {
            step();
            signs += shown.sign || shown.advice || shown.says ? 1 : 0;
        }
        return signs;
    }
};

/// The middle of a picture where a face of the prop is seen but not lit.
glm::dvec2 dark_picture(const Visit& visit) {
    for (const PlacedPicture& picture : visit.shown.table->pictures()) {
        const guidance::FaceReader reader(*visit.place.guidance);
        const glm::dvec2& at = picture.place.picture.centre_m;
        if (picture.artifact && picture.artifact != std::size_t{0} &&
            !reader.valid({{glm::dquat(1, 0, 0, 0), glm::dvec3(at, 0.0)}, visit.tracked_state.eye_m})) {
            return at;
        }
    }
    ADD_FAILURE() << "every picture lies in the zone";
    return {};
}

TEST(GuidedTable, GuidesOnAPictureOnlyAfterTheChoice) {
    Visit visit(true);
    visit.signs_in(milliseconds(800));
    const glm::dvec2 goal = dark_picture(visit);
    visit.slide_to(goal);
    EXPECT_EQ(visit.signs_in(milliseconds(1600)), 0);
    EXPECT_TRUE(visit.shown.table->ring);
    EXPECT_EQ(visit.shown.artifact, 0U);
    const int after = visit.signs_in(milliseconds(4000));
    EXPECT_NE(visit.shown.artifact, 0U);
    EXPECT_GT(after, 60); // the prop is still where its face is dark

    Visit without(false);
    without.signs_in(milliseconds(800));
    without.slide_to(goal);
    EXPECT_GT(without.signs_in(milliseconds(1600)), 30);
}

/// Two and a half seconds to a picture and back, through places where a face is dark.
TEST(GuidedTable, DoesNotGuideOnTheWayToAPictureAndBack) {
    for (const bool pictures : {true, false}) {
        Visit visit(true);
        visit.signs_in(milliseconds(800));
        const glm::dvec2 goal = dark_picture(visit);
        Visit slides(pictures);
        slides.signs_in(milliseconds(800));
        const int there = slides.slide_to(goal, 150);
        const int meanwhile = slides.signs_in(milliseconds(1600));
        const int back = slides.slide_to({0.0, 0.0}, 150);
        EXPECT_EQ(there + meanwhile + back > 0, !pictures) << there << ", " << meanwhile << ", " << back;
    }
}

TEST(GuidedTable, GuidesAPropThatStopsOrWandersInTheDark) {
    Visit stops(true);
    stops.signs_in(milliseconds(800));
    const glm::dvec2 goal = dark_picture(stops);
    const double reach = 0.4 - 0.15;
    const glm::dvec2 dark(std::copysign(reach, goal.x), -0.24); // beside all pictures
    EXPECT_EQ(stops.slide_to(dark, 150), 0);
    EXPECT_GT(stops.signs_in(milliseconds(1500)), 30);
    // A visitor who follows the advice keeps it.
    EXPECT_GT(stops.slide_to(glm::mix(dark, glm::dvec2(0.0), 0.15), 60), 50);

    Visit wanders(true);
    wanders.signs_in(milliseconds(800));
    int signs = wanders.slide_to(dark, 60);
    for (int k = 0; k < 5; ++k) {
        signs += wanders.slide_to(dark + glm::dvec2(0.0, k % 2 == 0 ? 0.04 : 0.0), 60);
    }
    EXPECT_GT(signs, 30);
}

/// A sign stays readable wherever it lies over pictures.
TEST(GuidedTable, PicturesUnderTheSignAreDim) {
    int over_pictures = 0;
    for (const glm::dvec3& eye : {glm::dvec3(0.0, -0.55, 0.5), glm::dvec3(0.75, 0.0, 0.5)}) {
        for (const double x : {-0.35, -0.3, -0.25, -0.2, -0.15, 0.15, 0.2, 0.25, 0.3, 0.35}) {
            for (const double y : {-0.2, -0.1, 0.0, 0.1, 0.2}) {
                Visit visit(true);
                visit.tracked_state.eye_m = eye;
                visit.signs_in(milliseconds(800));
                visit.slide_to({x, y}, 10);
                visit.signs_in(milliseconds(1400));
                int here = 0;
                for (const PlacedPicture& picture : visit.shown.table->pictures()) {
                    if (visit.shown.sign &&
                        typography::clearance(typography::hull_of({}, visit.shown.sign->corners_m).corners(),
                                              picture.place.whole().corners()) <= 0.0) {
                        ++here;
                        EXPECT_LE(picture.brightness, 0.121);
                    }
                }
                over_pictures += here;
            }
        }
    }
    EXPECT_GT(over_pictures, 2);
}

TEST(GuidedTable, WordsLieBesideThePictures) {
    Visit visit(true);
    visit.signs_in(milliseconds(800));
    visit.slide_to(dark_picture(visit));
    int seen = 0;
    for (int k = 0; k < 500; ++k) {
        visit.step();
        if (visit.shown.advice) {
            ++seen;
            for (const PlacedPicture& picture : visit.shown.table->pictures()) {
                EXPECT_GT(typography::clearance(visit.shown.advice->rectangle.corners(),
                                                picture.place.whole().corners()),
                          0.0);
            }
        }
    }
    EXPECT_GT(seen, 30);
}

TEST(GuidedTable, HidesTheZoneFrameWhilePicturesAreShown) {
    for (const bool pictures : {true, false}) {
        Visit visit(pictures);
        visit.slide_to({0.30, -0.1});
        EXPECT_EQ(visit.shown.zone_share > 0.5, !pictures);
    }
}

/// A corner of the prop's base lies in the dark, and no part of the artifact is seen through it.
TEST(GuidedTable, DoesNotGuideWhileTheArtifactIsWhollyVisible) {
    constexpr glm::dvec2 at(0.20, 0.05);
    for (const bool known : {true, false}) {
        Visit visit(false, known ? settings::usual_artifact(settings::make_prop(settings::Settings().prop))
                                 : std::vector<glm::dvec3>());
        visit.tracked_state.table_from_prop.rotation =
            glm::angleAxis(0.25 * std::numbers::pi, glm::dvec3(0, 0, 1));
        visit.tracked_state.eye_m = visit.shipped.eye.default_m;
        visit.signs_in(milliseconds(800));
        visit.slide_to(at);
        const guidance::FaceReader reader(*visit.place.guidance);
        ASSERT_FALSE(reader.valid({visit.tracked_state.table_from_prop, visit.tracked_state.eye_m}));
        const int signs = visit.signs_in(milliseconds(3000));
        EXPECT_EQ(signs > 60, !known);
        EXPECT_EQ(signs == 0, known);
    }
}

/// The frame is that of the shown artifact, if it has one.
TEST(GuidedTable, FrameUsesTheShownArtifactsZone) {
    Visit visit(false);
    CatalogueEntry own{{"en"}, {{{0.2, 0.05}}}, {}};
    own.zone = ZoneFrame({{0.0, 0.0}, {0.1, 0.05}}, 0.15, {0.8, 0.5});
    visit.exhibit.emplace(Catalogue{own, {{"en"}, {{{0.2, 0.05}}}, {}}}, visit.place, "en", visit.now);
    visit.step();
    EXPECT_EQ(visit.shown.zone_sides[0].centre_m, own.zone->sides()[0].centre_m);
    EXPECT_NE(visit.shown.zone_sides[0].centre_m, visit.place.zone.sides()[0].centre_m);
}

} // namespace
} // namespace frustumscreen::exhibit
