#include "app/exhibit/table_browser.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <set>

namespace frustumscreen::exhibit {
namespace {

using std::chrono::milliseconds;

TableSetUp shipped(std::size_t artifacts) {
    TableSetUp set_up;
    set_up.artifacts = artifacts;
    set_up.picture_m = {{-0.4, -0.25}, {0.4, -0.25}, {0.4, 0.25}, {-0.4, 0.25}};
    set_up.prop = geometry::make_frustum(geometry::shipped_frustum);
    set_up.lens_m = {0.0, 0.0, 1.5};
    return set_up;
}

struct Visitor {
    TableSetUp set_up;
    TableBrowser browser;
    TableBrowser::Input input;
    MonotonicTime now{};

    explicit Visitor(std::size_t artifacts) : set_up(shipped(artifacts)), browser(set_up) { put({0.0, 0.0}); }
    void put(const glm::dvec2& at) {
        input.prop_m = at;
        input.shadow =
            typography::hidden_by_prop(set_up.prop, {{1, 0, 0, 0}, glm::dvec3(at, 0.0)}, set_up.lens_m);
    }
    /// The chosen artifact comes into the prop.
    void wait(double seconds) {
        for (double s = 0.0; s < seconds; s += 1.0 / 60.0) {
            now += std::chrono::microseconds(16667);
            if (const std::optional<std::size_t> chosen = browser.step(now, input)) {
                input.artifact = *chosen;
            }
        }
    }
    [[nodiscard]] std::set<std::size_t> bright() const {
        std::set<std::size_t> artifacts;
        for (const PlacedPicture& picture : browser.presented().pictures()) {
            if (picture.artifact && picture.brightness >= 1.0) {
                artifacts.insert(*picture.artifact);
            }
        }
        return artifacts;
    }
    [[nodiscard]] const PlacedPicture& picture_of(std::optional<std::size_t> artifact) const {
        for (const PlacedPicture& picture : browser.presented().pictures()) {
            if (picture.artifact == artifact) {
                return picture;
            }
        }
        ADD_FAILURE() << "it is not on this page";
        return browser.presented().places[0];
    }
};

TEST(TableBrowser, ShowsTheOthersAndChoosesTheRestedPicture) {
    Visitor visitor(6);
    visitor.wait(0.6);
    EXPECT_EQ(visitor.bright(), (std::set<std::size_t>{1, 2, 3, 4, 5}));
    const glm::dvec2 place_of_first = visitor.picture_of(0).place.picture.centre_m;
    const glm::dvec2 place_of_fifth = visitor.picture_of(4).place.picture.centre_m;
    visitor.put(place_of_fifth);
    visitor.wait(1.0);
    EXPECT_EQ(visitor.input.artifact, 0U);
    ASSERT_TRUE(visitor.browser.presented().ring);
    EXPECT_EQ(visitor.browser.presented().pictures()[*visitor.browser.presented().ring].artifact, 4U);
    EXPECT_NEAR(visitor.browser.presented().ring_full, 0.8 / 1.5, 0.03);
    visitor.wait(1.0);
    EXPECT_EQ(visitor.input.artifact, 4U);
    visitor.put({0.0, 0.0});
    visitor.wait(1.0);
    // One picture went and one came; all others stayed in place.
    EXPECT_EQ(visitor.bright(), (std::set<std::size_t>{0, 1, 2, 3, 5}));
    EXPECT_EQ(visitor.picture_of(0).place.picture.centre_m, place_of_first);
    // The chosen one's own place is empty: nothing is chosen there.
    visitor.put(place_of_fifth);
    visitor.wait(3.0);
    EXPECT_EQ(visitor.input.artifact, 4U);
    EXPECT_FALSE(visitor.browser.presented().ring);
}

TEST(TableBrowser, LastPlaceTurnsPagesAndAnArtifactOpensItsPage) {
    Visitor visitor(50);
    visitor.wait(0.6);
    const TableLayout layout = lay_out_table(visitor.set_up, 0);
    const std::size_t pages = layout.pages();
    ASSERT_GT(pages, 3U);
    std::set<std::size_t> seen = visitor.bright();
    for (std::size_t page = 1; page < pages; ++page) {
        visitor.put(visitor.picture_of(std::nullopt).place.picture.centre_m);
        visitor.wait(4.0); // one page: the prop must leave the place before it leads on again
        visitor.put({0.0, 0.0});
        visitor.wait(0.6);
        const std::set<std::size_t> more = visitor.bright();
        EXPECT_FALSE(more.empty());
        seen.insert(more.begin(), more.end());
        EXPECT_EQ(visitor.input.artifact, 0U);
    }
    EXPECT_EQ(seen.size(), 49U); // all but the one in the prop
    visitor.input.artifact = 30; // chosen with a button
    visitor.wait(1.0);
    std::set<std::size_t> on_page;
    for (std::size_t artifact = 0; artifact < 50; ++artifact) {
        if (artifact != 30 && layout.page_of(artifact) == layout.page_of(30)) {
            on_page.insert(artifact);
        }
    }
    EXPECT_GT(on_page.size(), 3U);
    EXPECT_EQ(visitor.bright(), on_page);
}

TEST(TableBrowser, PicturesTurnToTheReaderInTheDark) {
    Visitor visitor(8);
    visitor.wait(0.6);
    visitor.input.quarter_turns = 3;
    bool dark = false;
    for (int frame = 0; frame < 60; ++frame) {
        visitor.wait(1.0 / 60.0);
        const std::span<const PlacedPicture> pictures = visitor.browser.presented().pictures();
        dark = dark || std::all_of(pictures.begin(), pictures.end(),
                                   [](const PlacedPicture& each) { return each.brightness < 0.02; });
        for (const PlacedPicture& picture : pictures) {
            if (picture.brightness > 0.02) {
                EXPECT_EQ(picture.place.picture.quarter_turns, dark ? 3 : 0);
            }
        }
    }
    EXPECT_TRUE(dark);
    EXPECT_EQ(visitor.bright().size(), 7U);
    EXPECT_EQ(visitor.picture_of(1).place.picture.quarter_turns, 3);
    EXPECT_EQ(visitor.browser.obstacles().size(), lay_out_table(visitor.set_up, 3).places.size());
}

/// No picture jumps: it dims at most as fast as its fade and the prop's shadow.
TEST(TableBrowser, BrightnessNeverJumpsOnRandomInput) {
    std::mt19937_64 random(41);
    Visitor visitor(30);
    visitor.wait(0.6);
    std::array<double, max_table_places> before{};
    std::array<glm::dvec2, max_table_places> places{};
    const auto note = [&] {
        for (std::size_t k = 0; k < visitor.browser.presented().count; ++k) {
            before[k] = visitor.browser.presented().places[k].brightness;
            places[k] = visitor.browser.presented().places[k].place.picture.centre_m;
        }
    };
    note();
    for (int frame = 0; frame < 20'000; ++frame) {
        if (random() % 40 == 0) {
            visitor.input.artifact = random() % 30;
        }
        if (random() % 60 == 0) {
            visitor.input.quarter_turns = static_cast<int>(random() % 4);
        }
        visitor.wait(1.0 / 60.0);
        for (std::size_t k = 0; k < visitor.browser.presented().count; ++k) {
            const PlacedPicture& picture = visitor.browser.presented().places[k];
            const bool moved = picture.place.picture.centre_m != places[k];
            // Two eased fades of 250 ms at once, frames of 16.7 ms.
            EXPECT_LT(std::abs(picture.brightness - (moved ? 0.0 : before[k])), 2.0 * 1.5 / 15.0 + 0.01)
                << frame;
            EXPECT_TRUE(!moved || before[k] < 0.25) << frame;
        }
        note();
        if (HasFailure()) {
            break;
        }
    }
}

/// The sign glides to and fro over one picture: it dims once, without a jump, and brightens when the sign goes.
TEST(TableBrowser, PicturesUnderASignDim) {
    Visitor visitor(6);
    visitor.wait(0.6);
    const typography::TableRectangle under = visitor.picture_of(4).place.picture;
    double before = 1.0;
    int changes_of_way = 0;
    for (int k = 0; k < 600; ++k) {
        const bool signs = k < 420;
        const double glides =
            std::sin(k * 2.0 * 3.14159 / 108.0); // the sign is beside the picture for half of the time
        const double below = 0.5 * under.size_m.y + 0.026 + 0.02 - 0.02 * glides;
        const typography::TableRectangle sign{under.centre_m - glm::dvec2(0.0, below), glm::dvec2(0.04)};
        visitor.input.sign = signs ? std::optional(typography::polygon_of(sign)) : std::nullopt;
        visitor.wait(1.0 / 60.0);
        const double now = visitor.picture_of(4).brightness;
        EXPECT_LE(std::abs(now - before), 0.15);
        changes_of_way += (k > 30 && k < 420 && std::abs(now - before) > 1e-9) ? 1 : 0;
        before = now;
        if (k == 419) {
            EXPECT_NEAR(now, TableBrowser::dimmed, 1e-9);
            EXPECT_EQ(visitor.bright(), (std::set<std::size_t>{1, 2, 3, 5}));
        }
    }
    EXPECT_LT(changes_of_way, 30);
    EXPECT_EQ(visitor.bright(), (std::set<std::size_t>{1, 2, 3, 4, 5}));
}

} // namespace
} // namespace frustumscreen::exhibit
