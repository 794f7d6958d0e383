// Guidance and the pictures on the table: what is being chosen is no mistake, and words lie beside pictures.

#include "app/exhibit/guidance_setup.h"
#include "app/settings/lit_zone.h"
#include "tests/exhibit/exhibits.h"

#include <gtest/gtest.h>

#include <array>

namespace frustumscreen {
namespace {

using sample::start;
using std::chrono::milliseconds;

struct Visit {
    Settings shipped;
    ExhibitPlace place;
    std::optional<Exhibit> exhibit;
    MonotonicTime now = start;
    Situation situation = sample::situation(start);
    Presentation shown;

    explicit Visit(bool pictures) {
        place.prop = make_prop(shipped.prop);
        place.lens_m = shipped.projector.table_from_projector.translation;
        place.picture_m = picture_on_table(shipped, 0.0);
        place.guidance = guidance_setup(shipped);
        place.table_pictures = pictures;
        place.zone = ZoneFrame(lit_rectangle(shipped), 0.15, {0.8, 0.5});
        for (const char* key : {"slide_left", "slide_right", "slide_nearer", "slide_farther",
                                "slide_left_a_little", "slide_right_a_little", "slide_nearer_a_little",
                                "slide_farther_a_little", "turn", "turn_left", "turn_right"}) {
            words.texts.push_back({key, {{0.1, 0.02}}});
        }
        place.words = {words};
        const CatalogueEntry entry{{"en"}, {{{0.2, 0.05}, {0.1, 0.1}}}, {}};
        exhibit.emplace(Catalogue(6, entry), place, "en", start);
    }
    void step() {
        now += milliseconds(16);
        situation.time = now;
        shown = exhibit->step(now, {}, situation);
    }
    /// Slides there in half a second.
    void slide_to(const glm::dvec2& goal) {
        const glm::dvec3 from = situation.table_from_prop.translation;
        for (int k = 1; k <= 30; ++k) {
            situation.table_from_prop.translation = glm::mix(from, glm::dvec3(goal, 0.0), k / 30.0);
            step();
        }
    }
    /// Steps of this time with a sign.
    int signs_in(milliseconds time) {
        int signs = 0;
        for (milliseconds each{0}; each < time; each += milliseconds(16)) {
            step();
            signs += shown.sign || shown.advice || shown.says ? 1 : 0;
        }
        return signs;
    }

    AdviceLanguage words{"en", {}};
};

/// The middle of a picture where a prop's face is seen and not lit.
glm::dvec2 dark_picture(const Visit& visit) {
    for (const PlacedPicture& picture : visit.shown.table->pictures()) {
        const FaceReader reader(*visit.place.guidance);
        const glm::dvec2& at = picture.place.picture.centre_m;
        if (picture.artifact && picture.artifact != std::size_t{0} &&
            !reader.valid({{glm::dquat(1, 0, 0, 0), glm::dvec3(at, 0.0)}, visit.situation.eye_m})) {
            return at;
        }
    }
    ADD_FAILURE() << "every picture lies in the zone";
    return {};
}

TEST(GuidedTable, IsQuietWhileThePropIsOnAPictureAndGuidesAfterTheChoice) {
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
                EXPECT_GT(clearance(visit.shown.advice->rectangle.corners(), picture.place.whole().corners()),
                          0.0);
            }
        }
    }
    EXPECT_GT(seen, 30);
}

TEST(GuidedTable, TheZonesFrameDoesNotCrossPictures) {
    for (const bool pictures : {true, false}) {
        Visit visit(pictures);
        visit.slide_to({0.30, -0.1});
        EXPECT_EQ(visit.shown.zone_share > 0.5, !pictures);
    }
}

} // namespace
} // namespace frustumscreen
