// The exhibit with its set on the table: choosing by the prop and by buttons, captions beside pictures.

#include "tests/exhibit/exhibits.h"
#include "tests/render/counted_new.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

namespace frustumscreen::exhibit {
namespace {

using sample::start;
using std::chrono::milliseconds;

struct Table {
    MonotonicTime now = start;
    tracking::TrackedState tracked_state = sample::tracked_state(start);
    Exhibit exhibit;
    Presentation shown;

    explicit Table(std::size_t artifacts) : exhibit(make(artifacts)) {}
    static Exhibit make(std::size_t artifacts) {
        const CatalogueEntry entry{{"en"}, {{{0.2, 0.05}, {0.1, 0.1}}}};
        ExhibitPlace place = sample::place();
        place.table_pictures = true;
        return {Catalogue(artifacts, entry), place, "en", start};
    }
    void wait(milliseconds time, std::span<const settings::Command> commands = {}) {
        for (milliseconds each{0}; each < time; each += milliseconds(16)) {
            now += milliseconds(16);
            tracked_state.time = now;
            shown = exhibit.step(now, each.count() == 0 ? commands : std::span<const settings::Command>{},
                                 tracked_state);
        }
    }
    void put(const glm::dvec2& at) { tracked_state.table_from_prop.translation = glm::dvec3(at, 0.0); }
    [[nodiscard]] glm::dvec2 place_of(std::size_t artifact) const {
        for (const PlacedPicture& picture : shown.table->pictures()) {
            if (picture.artifact == artifact) {
                return picture.place.picture.centre_m;
            }
        }
        ADD_FAILURE() << "artifact " << artifact << " is not on the table";
        return {};
    }
    [[nodiscard]] std::set<std::size_t> bright() const {
        std::set<std::size_t> artifacts;
        for (const PlacedPicture& picture : shown.table->pictures()) {
            if (picture.artifact && picture.brightness >= 1.0) {
                artifacts.insert(*picture.artifact);
            }
        }
        return artifacts;
    }
};

TEST(ExhibitTable, ShowsThePictureThatThePropRestsOn) {
    Table table(5);
    table.wait(milliseconds(800));
    ASSERT_NE(table.shown.table, nullptr);
    EXPECT_EQ(table.bright(), (std::set<std::size_t>{1, 2, 3, 4}));
    EXPECT_TRUE(table.shown.settled);
    table.put(table.place_of(3));
    table.wait(milliseconds(1200));
    EXPECT_EQ(table.shown.artifact, 0U);
    EXPECT_TRUE(table.shown.table->ring);
    table.wait(milliseconds(1500));
    EXPECT_EQ(table.shown.artifact, 3U);
    table.put({0.0, 0.0});
    table.wait(milliseconds(800));
    EXPECT_EQ(table.bright(), (std::set<std::size_t>{0, 1, 2, 4}));
}

TEST(ExhibitTable, ChoosesByButtonsAndByRest) {
    Table table(4);
    table.wait(milliseconds(800));
    table.wait(milliseconds(800), std::array{settings::Command::NextArtifact});
    EXPECT_EQ(table.shown.artifact, 1U);
    EXPECT_EQ(table.bright(), (std::set<std::size_t>{0, 2, 3}));
    table.put(table.place_of(0));
    table.wait(milliseconds(3000));
    EXPECT_EQ(table.shown.artifact, 0U);
    table.put({0.0, 0.0});
    table.wait(milliseconds(800), std::array{settings::Command::PreviousArtifact});
    EXPECT_EQ(table.shown.artifact, 3U);
}

TEST(ExhibitTable, ChoosesNothingInStaffModeOrWithALostProp) {
    Table table(4);
    table.wait(milliseconds(800));
    table.put(table.place_of(2));
    table.wait(milliseconds(5000), std::array{settings::Command::StaffMode});
    EXPECT_TRUE(table.shown.staff);
    EXPECT_EQ(table.shown.artifact, 0U);

    Table lost(4);
    lost.wait(milliseconds(800));
    lost.put(lost.place_of(2));
    lost.tracked_state.prop_known = false;
    lost.tracked_state.prop_age = milliseconds(500);
    lost.wait(milliseconds(5000));
    EXPECT_EQ(lost.shown.artifact, 0U);
}

TEST(ExhibitTable, CaptionLiesBesideThePictures) {
    Table table(10);
    for (int side = 0; side < 4; ++side) {
        const double azimuth = 1.5707963267948966 * (side - 1);
        table.tracked_state.eye_m = {0.6 * std::cos(azimuth), 0.6 * std::sin(azimuth), 0.5};
        table.wait(milliseconds(1500));
        ASSERT_TRUE(table.shown.caption) << side;
        EXPECT_EQ(table.shown.caption->brightness, 1.0) << side;
        EXPECT_EQ(table.bright().size(), 9U) << side;
        for (const PlacedPicture& picture : table.shown.table->pictures()) {
            EXPECT_EQ(picture.place.picture.quarter_turns, side);
            EXPECT_GE(typography::clearance(table.shown.caption->rectangle.corners(),
                                            picture.place.whole().corners()),
                      0.008 - 1e-9)
                << side;
        }
    }
}

TEST(ExhibitTable, AStepAllocatesNothing) {
    if (!synthetic::allocations_are_counted) {
        GTEST_SKIP() << "the sanitizers have allocations of their own";
    }
    Table table(9);
    table.wait(milliseconds(800));
    const glm::dvec2 goal = table.place_of(5);
    const long before = synthetic::allocations_so_far();
    table.put(goal);
    table.wait(milliseconds(3000));
    table.tracked_state.eye_m = {0.6, 0.0, 0.5};
    table.put({0.0, 0.0});
    table.wait(milliseconds(2000));
    EXPECT_EQ(synthetic::allocations_so_far(), before);
    EXPECT_EQ(table.shown.artifact, 5U);
}

TEST(ExhibitTable, IsAbsentWithoutPictures) {
    Exhibit exhibit = sample::exhibit(3, {"en"});
    EXPECT_EQ(exhibit.step(start + milliseconds(16), {}, sample::tracked_state(start)).table, nullptr);
}

} // namespace
} // namespace frustumscreen::exhibit
