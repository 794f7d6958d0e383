#include "app/exhibit/table_layout.h"
#include "app/settings/lit_zone.h"
#include "app/typography/visitor_side.h"
#include "tests/exhibit/some_tables.h"
#include "tests/folders.h"
#include "tests/render/counted_new.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <set>

namespace frustumscreen::exhibit {
namespace {

double distance_inside(const std::vector<glm::dvec2>& polygon, const glm::dvec2& point) {
    double least = 1e9;
    for (std::size_t k = 0; k < polygon.size(); ++k) {
        const glm::dvec2 along = glm::normalize(polygon[(k + 1) % polygon.size()] - polygon[k]);
        const glm::dvec2 off = point - polygon[k];
        least = std::min(least, along.x * off.y - along.y * off.x);
    }
    return least;
}

double distance_between(const typography::TableRectangle& a, const typography::TableRectangle& b) {
    return typography::clearance(a.corners(), b.corners());
}

void expect_apart_and_inside(const TableSetUp& set_up, const TableLayout& layout) {
    for (std::size_t k = 0; k < layout.places.size(); ++k) {
        const TablePlace& place = layout.places[k];
        for (const typography::TableRectangle& part : {place.picture, place.title}) {
            for (const glm::dvec2& corner : part.corners()) {
                EXPECT_GE(distance_inside(set_up.picture_m, corner), 0.008 - 1e-9);
            }
        }
        EXPECT_GT(distance_between(place.picture, place.title), 0.003);
        for (std::size_t other = 0; other < k; ++other) {
            EXPECT_GE(distance_between(place.whole(), layout.places[other].whole()), 0.012 - 1e-9);
        }
        if (layout.caption) {
            EXPECT_GE(distance_between(place.whole(), *layout.caption), 0.012 - 1e-8);
        }
    }
}

void expect_clear_of_home(const TableSetUp& set_up, const TableLayout& layout, std::mt19937_64& random) {
    for (int k = 0; k < 12; ++k) {
        const geometry::RigidTransform home = standing(set_up.home_m, between(random, -3.2, 3.2));
        const std::optional<typography::TablePolygon> shadow =
            typography::hidden_by_prop(set_up.prop, home, set_up.lens_m);
        ASSERT_TRUE(shadow);
        for (const TablePlace& place : layout.places) {
            EXPECT_EQ(place_brightness(place, shadow), 1.0);
            EXPECT_GE(typography::clearance(place.picture.corners(), shadow->corners()), 0.015 - 1e-9);
            EXPECT_GE(typography::clearance(place.title.corners(), shadow->corners()), 0.015 - 1e-9);
        }
        if (layout.caption) {
            EXPECT_GE(typography::clearance(layout.caption->corners(), shadow->corners()), 0.02);
        }
    }
}

void expect_every_artifact_once(const TableLayout& layout) {
    std::set<std::size_t> seen;
    for (std::size_t page = 0; page < layout.pages(); ++page) {
        std::size_t on_page = 0;
        for (std::size_t place = 0; place < layout.places.size(); ++place) {
            const std::optional<std::size_t> artifact = layout.artifact_at(page, place);
            if (artifact) {
                EXPECT_FALSE(layout.leads_on(place));
                EXPECT_EQ(layout.page_of(*artifact), page);
                EXPECT_TRUE(seen.insert(*artifact).second);
                ++on_page;
            }
        }
        EXPECT_GT(on_page, 0U);
    }
    EXPECT_EQ(seen.size(), layout.places.empty() ? 0U : layout.artifacts);
    EXPECT_EQ(layout.has_more, layout.pages() > 1);
}

TEST(TableLayout, NothingOverlapsOrLiesUnderThePropAtHome) {
    std::mt19937_64 random(14);
    std::map<std::size_t, int> by_places;
    int with_caption = 0;
    const int tables =
        synthetic::allocations_are_counted ? 2400 : 1000; // a sanitizer takes ten times as long
    for (int k = 0; k < tables; ++k) {
        const TableSetUp set_up = some_set_up(random);
        const int side = static_cast<int>(random() % 4);
        const TableLayout layout = lay_out_table(set_up, side);
        ++by_places[layout.places.size()];
        with_caption += layout.caption ? 1 : 0;
        EXPECT_LE(layout.places.size(), max_table_places);
        for (const TablePlace& place : layout.places) {
            EXPECT_EQ(place.picture.quarter_turns, side);
            EXPECT_EQ(place.title.quarter_turns, side);
            EXPECT_EQ(place.picture.size_m.x, place.picture.size_m.y);
            EXPECT_GE(place.picture.size_m.x, min_table_picture_m);
            EXPECT_LE(place.picture.size_m.x, max_table_picture_m + 1e-12);
            EXPECT_EQ(place.picture.size_m, layout.places.front().picture.size_m);
            // For the reader the title lies below the picture.
            const glm::dvec2 down = typography::turned(place.title.centre_m - place.picture.centre_m, -side);
            EXPECT_LT(down.y, 0.0);
            EXPECT_NEAR(down.x, 0.0, 1e-12);
        }
        expect_apart_and_inside(set_up, layout);
        expect_clear_of_home(set_up, layout, random);
        expect_every_artifact_once(layout);
        if (HasFailure()) {
            FAIL() << "set-up " << k;
        }
    }
    // The test covers what it should: tables of all kinds.
    EXPECT_GT(by_places[0], tables / 48);
    EXPECT_LT(by_places[0], tables / 3);
    EXPECT_GT(by_places[12], tables / 16);
    EXPECT_GT(by_places.size(), 10U);
    EXPECT_GT(with_caption, tables * 5 / 24);
}

bool equal(const typography::TableRectangle& a, const typography::TableRectangle& b) {
    return a.centre_m == b.centre_m && a.size_m == b.size_m && a.quarter_turns == b.quarter_turns;
}

TEST(TableLayout, IsDeterministic) {
    std::mt19937_64 random(15);
    for (int k = 0; k < 200; ++k) {
        const TableSetUp set_up = some_set_up(random);
        const TableLayout once = lay_out_table(set_up, k % 4);
        const TableLayout again = lay_out_table(set_up, k % 4);
        ASSERT_EQ(once.places.size(), again.places.size());
        EXPECT_EQ(once.has_more, again.has_more);
        for (std::size_t place = 0; place < once.places.size(); ++place) {
            EXPECT_TRUE(equal(once.places[place].picture, again.places[place].picture));
            EXPECT_TRUE(equal(once.places[place].title, again.places[place].title));
        }
    }
}

/// A table that looks alike from two or four sides is laid out alike for the readers there.
TEST(TableLayout, ReadersOnOppositeSidesSeeTheSame) {
    TableSetUp set_up;
    set_up.artifacts = 9;
    set_up.picture_m = {{-0.4, -0.25}, {0.4, -0.25}, {0.4, 0.25}, {-0.4, 0.25}};
    set_up.prop = geometry::make_frustum(geometry::shipped_frustum);
    set_up.lens_m = {0.0, 0.0, 1.5};
    for (const int side : {0, 1}) {
        const TableLayout here = lay_out_table(set_up, side);
        const TableLayout there = lay_out_table(set_up, side + 2);
        ASSERT_EQ(here.places.size(), there.places.size());
        ASSERT_EQ(here.places.size(), 9U);
        for (std::size_t k = 0; k < here.places.size(); ++k) {
            EXPECT_LT(glm::distance(here.places[k].picture.centre_m, -there.places[k].picture.centre_m),
                      1e-9);
        }
    }
}

TableSetUp shipped_table(const char* name, std::size_t artifacts) {
    const Result<settings::CheckedSettings> settings = settings::load_settings(
        std::filesystem::path(source_dir() + "/config") / (std::string(name) + ".toml"));
    TableSetUp set_up;
    if (!settings) {
        ADD_FAILURE() << settings.error().message;
        return set_up;
    }
    set_up.artifacts = artifacts;
    set_up.picture_m = settings::picture_on_table(**settings, 0.0);
    set_up.prop = settings::make_prop((*settings)->prop);
    set_up.lens_m = (*settings)->projector.table_from_projector.translation;
    set_up.home_m = settings::lit_rectangle(**settings).centre_m;
    set_up.captions_m = {{0.30, 0.06}, {0.16, 0.10}, {0.075, 0.20}};
    return set_up;
}

/// Number of places without a mirror image about the line on which the reader sees the prop.
std::size_t places_without_image(const TableSetUp& set_up, const TableLayout& layout, int side) {
    const double line = typography::turned(set_up.home_m, -side).x;
    const auto as_seen = [&](const TablePlace& place) {
        return typography::turned(place.picture.centre_m, -side);
    };
    return static_cast<std::size_t>(
        std::count_if(layout.places.begin(), layout.places.end(), [&](const TablePlace& place) {
            const glm::dvec2 image(2.0 * line - as_seen(place).x, as_seen(place).y);
            return std::none_of(layout.places.begin(), layout.places.end(), [&](const TablePlace& other) {
                return glm::distance(as_seen(other), image) < 1e-6;
            });
        }));
}

TEST(TableLayout, IsSymmetricAboutTheReadersViewOfTheProp) {
    for (const char* name : {"kiosk", "cube", "near"}) {
        for (const std::size_t artifacts : {2U, 3U, 4U, 6U, 7U, 9U, 12U, 20U}) {
            const TableSetUp set_up = shipped_table(name, artifacts);
            for (int side = 0; side < 4; ++side) {
                const TableLayout layout = lay_out_table(set_up, side);
                EXPECT_LE(places_without_image(set_up, layout, side), layout.places.size() % 2)
                    << name << ", " << artifacts << " artifacts, side " << side;
            }
        }
    }
    std::mt19937_64 random(18);
    int laid_out = 0;
    int symmetric = 0;
    for (int k = 0; k < 200; ++k) {
        const TableSetUp set_up = some_set_up(random);
        const int side = static_cast<int>(random() % 4);
        const TableLayout layout = lay_out_table(set_up, side);
        laid_out += layout.places.empty() ? 0 : 1;
        const bool matched = places_without_image(set_up, layout, side) <= layout.places.size() % 2;
        symmetric += !layout.places.empty() && matched ? 1 : 0;
    }
    RecordProperty("laid_out", laid_out);
    RecordProperty("symmetric", symmetric);
    EXPECT_GT(laid_out, 100);
    EXPECT_GT(symmetric, laid_out * 8 / 10);
}

/// From the front of the shipped table, the rows have one distance, and so do the columns beside the prop.
TEST(TableLayout, GapsAreEvenOnTheShippedTable) {
    for (std::size_t artifacts = 2; artifacts <= 12; ++artifacts) {
        const TableSetUp set_up = shipped_table("kiosk", artifacts);
        const TableLayout layout = lay_out_table(set_up, 0);
        ASSERT_EQ(layout.places.size(), artifacts);
        std::set<long> rows; // in hundredths of a millimetre
        std::set<long> columns_on_the_left;
        for (const TablePlace& place : layout.places) {
            const glm::dvec2& at = place.picture.centre_m;
            rows.insert(std::lround(at.y * 1e5));
            if (at.x < set_up.home_m.x) {
                columns_on_the_left.insert(std::lround(at.x * 1e5));
            }
        }
        for (const std::set<long>& lines : {rows, columns_on_the_left}) {
            std::vector<long> at(lines.begin(), lines.end());
            for (std::size_t k = 2; k < at.size(); ++k) {
                EXPECT_LE(std::abs((at[k] - at[k - 1]) - (at[1] - at[0])), 3) << artifacts;
            }
        }
        EXPECT_LE(rows.size() * columns_on_the_left.size() * 2, artifacts + 3) << "a row is not full";
    }
}

struct Expected {
    const char* settings;
    std::size_t artifacts;
    std::size_t on_page; ///< seen from the front
    double picture_m;    ///< at least
};

TEST(TableLayout, ShippedTablesHoldTheExpectedNumber) {
    for (const Expected& expected :
         {Expected{"kiosk", 2, 2, 0.095}, Expected{"kiosk", 6, 6, 0.084}, Expected{"kiosk", 12, 12, 0.07},
          Expected{"kiosk", 50, 10, 0.07}, Expected{"cube", 3, 3, 0.085}, Expected{"cube", 12, 12, 0.06},
          Expected{"near", 4, 4, 0.05}, Expected{"near", 12, 3, 0.05}}) {
        const TableSetUp set_up = shipped_table(expected.settings, expected.artifacts);
        std::mt19937_64 random(1);
        for (int side = 0; side < 4; ++side) {
            const TableLayout layout = lay_out_table(set_up, side);
            ASSERT_FALSE(layout.places.empty());
            EXPECT_GE(layout.artifacts_on_page(), std::min<std::size_t>(3, expected.artifacts));
            if (side == 0) {
                EXPECT_EQ(layout.artifacts_on_page(), expected.on_page) << expected.settings;
                EXPECT_GE(layout.places.front().picture.size_m.x, expected.picture_m) << expected.settings;
            }
            expect_apart_and_inside(set_up, layout);
            expect_clear_of_home(set_up, layout, random);
            expect_every_artifact_once(layout);
        }
    }
}

TEST(TableLayout, HasNoPlacesWithoutRoom) {
    TableSetUp set_up;
    set_up.artifacts = 5;
    set_up.prop = geometry::make_frustum(geometry::shipped_frustum);
    set_up.lens_m = {0.0, 0.0, 1.5};
    EXPECT_TRUE(lay_out_table(set_up, 0).places.empty()); // no picture at all
    set_up.picture_m = {{-0.17, -0.17}, {0.17, -0.17}, {0.17, 0.17}, {-0.17, 0.17}};
    EXPECT_TRUE(lay_out_table(set_up, 0).places.empty());
    EXPECT_EQ(lay_out_table(set_up, 0).pages(), 0U);
    set_up.picture_m = {{-0.6, -0.5}, {0.6, -0.5}, {0.6, 0.5}, {-0.6, 0.5}};
    EXPECT_EQ(lay_out_table(set_up, 0).places.size(), 5U);
    set_up.lens_m.z = 0.1; // lower than the prop: its shadow is infinite
    EXPECT_TRUE(lay_out_table(set_up, 0).places.empty());
    set_up.lens_m.z = 1.5;
    set_up.artifacts = 1; // no other artifact
    EXPECT_TRUE(lay_out_table(set_up, 0).places.empty());
}

} // namespace
} // namespace frustumscreen::exhibit
