// The desk of windows: where they come, how they fade, what pushes them and when they go; in simulated time.
#include "app/bench/truth/seeded_situations.h"
#include "app/exhibit/table_contact.h"
#include "tests/exhibit/flash_counter.h"
#include "tests/exhibit/walked_exhibit.h"
#include "tests/render/counted_new.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>

namespace frustumscreen::exhibit {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;
using typography::TableRectangle;

constexpr Nanoseconds frame = milliseconds(20);

std::array<glm::dvec2, 4> square(const glm::dvec2& middle, double half, double turn) {
    std::array<glm::dvec2, 4> corners{};
    for (std::size_t k = 0; k < corners.size(); ++k) {
        const double at = turn + std::numbers::pi * (0.25 + 0.5 * static_cast<double>(k));
        corners.at(k) = middle + half * std::sqrt(2.0) * glm::dvec2(std::cos(at), std::sin(at));
    }
    return corners;
}

std::array<glm::dvec2, 4> moved(std::array<glm::dvec2, 4> corners, const glm::dvec2& by) {
    for (glm::dvec2& corner : corners) {
        corner += by;
    }
    return corners;
}

/// Compares with a search in all directions: no shorter slide makes the two clear of each other.
TEST(SlideClear, FindsTheShortestSeparatingSlide) {
    bench::Seeded random(5);
    int touching = 0;
    for (int k = 0; k < 400; ++k) {
        const auto thing = square({random.between(-0.1, 0.1), random.between(-0.1, 0.1)},
                                  random.between(0.02, 0.06), random.between(0.0, 3.0));
        const auto other = square({0.0, 0.0}, random.between(0.02, 0.06), random.between(0.0, 3.0));
        const auto way = slide_clear(thing, other, 0.0);
        EXPECT_EQ(way.has_value(), typography::clearance(thing, other) <= 0.0);
        if (!way) {
            continue;
        }
        ++touching;
        EXPECT_GT(typography::clearance(moved(thing, 1.001 * *way), other), 0.0);
        for (int direction = 0; direction < 360; ++direction) {
            const double at = glm::radians(static_cast<double>(direction));
            const glm::dvec2 shorter = 0.99 * glm::length(*way) * glm::dvec2(std::cos(at), std::sin(at));
            EXPECT_EQ(typography::clearance(moved(thing, shorter), other), 0.0) << direction;
        }
    }
    EXPECT_GT(touching, 100);
}

/// A desk of its own: a square prop on a table of 0.8 x 0.5 m.
struct Desk {
    explicit Desk(std::size_t count = 3)
        : desk({.count = count, .size_m = {0.1, 0.1}},
               std::vector<glm::dvec2>{{-0.4, -0.25}, {0.4, -0.25}, {0.4, 0.25}, {-0.4, 0.25}}) {}

    void step(bool pins = false, Nanoseconds later = frame) {
        now += later;
        const auto shadow = square(prop_m, 0.08, 0.0);
        const WindowDesk::Input input{.artifact = artifact,
                                      .pin = pins,
                                      .shows = true,
                                      .eye_m = eye_m,
                                      .table_from_prop = {{1.0, 0.0, 0.0, 0.0}, glm::dvec3(prop_m, 0.0)},
                                      .shadow = typography::hull_of({}, shadow),
                                      .hidden = std::nullopt,
                                      .sign = std::nullopt,
                                      .stands = stands,
                                      .prop_m = prop_m,
                                      .quarter_turns = side,
                                      .obstacles = obstacles,
                                      .gone = gone};
        desk.step(now, input);
    }
    void run(Nanoseconds time, bool pins = false) {
        for (const MonotonicTime end = now + time; now < end; pins = false) {
            step(pins);
        }
    }
    [[nodiscard]] std::span<const PresentedWindow> windows() const { return desk.presented().windows(); }
    /// The windows that are lit, oldest first.
    [[nodiscard]] std::vector<PresentedWindow> lit() const {
        std::vector<PresentedWindow> lit;
        std::copy_if(windows().begin(), windows().end(), std::back_inserter(lit),
                     [](const PresentedWindow& window) { return window.brightness > 0.0; });
        return lit;
    }
    /// Moves the prop along, at a hand's speed.
    void slide(const glm::dvec2& to_m, double metres_per_s = 0.3) {
        const double step_m = metres_per_s * to_seconds(frame);
        while (glm::distance(prop_m, to_m) > step_m) {
            prop_m += step_m * glm::normalize(to_m - prop_m);
            step();
        }
        prop_m = to_m;
        step();
    }

    WindowDesk desk;
    MonotonicTime now = sample::start;
    glm::dvec2 prop_m{0.0};
    glm::dvec3 eye_m{0.0, -0.55, 0.5};
    std::size_t artifact = 0;
    bool stands = true, gone = false;
    int side = 0;
    std::vector<TableRectangle> obstacles;
};

TEST(WindowDesk, KeepsTheEyeOfThePressAndFadesInBesideTheProp) {
    Desk desk;
    desk.run(milliseconds(100));
    ASSERT_TRUE(desk.desk.can_pin());
    const glm::dvec3 eye = desk.eye_m;
    desk.step(true);
    double before = 0.0;
    for (int k = 0; k < 60; ++k) {
        desk.eye_m.x += 0.005; // the visitor walks on
        desk.step();
        ASSERT_EQ(desk.windows().size(), 1U);
        const double now = desk.windows()[0].brightness;
        EXPECT_GE(now, before);
        EXPECT_LE(now - before, 1.5 * to_seconds(frame) / WindowDesk::comes_s + 1e-9);
        EXPECT_EQ(desk.desk.can_pin(), k >= 24) << "the next one comes when this one is there: " << k;
        before = now;
    }
    EXPECT_EQ(before, 1.0);
    EXPECT_EQ(desk.windows()[0].eye_m, eye);
    EXPECT_EQ(desk.windows()[0].comings, 1U);
    const double clear =
        typography::clearance(desk.windows()[0].rectangle.corners(), square(desk.prop_m, 0.08, 0.0));
    EXPECT_GE(clear, 0.02);
    EXPECT_LE(clear, 0.06);
}

TEST(WindowDesk, ReplacesTheOldestWindowAtTheLimit) {
    Desk desk(3);
    desk.run(milliseconds(100));
    for (int k = 0; k < 40; ++k) {
        desk.artifact = static_cast<std::size_t>(k % 3);
        desk.step(true);
        for (int j = 0; j < 20 + 7 * (k % 9); ++j) {
            desk.step(j % 3 == 0);
            ASSERT_LE(desk.lit().size(), 3U);
        }
    }
    desk.run(seconds(3));
    ASSERT_EQ(desk.lit().size(), 3U);
    EXPECT_LT(desk.lit()[0].number, desk.lit()[1].number);
    const std::uint32_t oldest = desk.lit()[0].number;
    desk.run(seconds(3), true);
    ASSERT_EQ(desk.lit().size(), 3U);
    EXPECT_EQ(desk.lit()[0].number, oldest + 1);
    EXPECT_EQ(desk.lit()[2].number, oldest + 3);
}

TEST(WindowDesk, PutsAnotherStateOfTheSameArtifactBesideTheFirst) {
    Desk desk;
    desk.prop_m = {-0.25, 0.0};
    desk.run(milliseconds(100));
    desk.run(seconds(1), true);
    desk.artifact = 1;
    desk.run(seconds(1), true);
    desk.artifact = 0;
    desk.run(seconds(1), true);
    const auto lit = desk.lit();
    ASSERT_EQ(lit.size(), 3U);
    const glm::dvec2 off = glm::abs(lit[2].rectangle.centre_m - lit[0].rectangle.centre_m);
    EXPECT_LT(off.y, 0.011);
    EXPECT_LT(off.x, 0.14);
}

TEST(WindowDesk, PropPushesWindowsAlongAndOffTheTable) {
    Desk desk;
    desk.run(milliseconds(100));
    desk.run(seconds(1), true);
    const glm::dvec2 at = desk.windows()[0].rectangle.centre_m;
    const glm::dvec2 along = glm::abs(at.x) > glm::abs(at.y) ? glm::dvec2(at.x > 0 ? 1.0 : -1.0, 0.0)
                                                             : glm::dvec2(0.0, at.y > 0 ? 1.0 : -1.0);
    double last = glm::dot(at, along);
    for (int k = 0; k < 15; ++k) {
        desk.slide(desk.prop_m + 0.01 * along);
        const PresentedWindow& window = desk.windows()[0];
        EXPECT_GT(window.brightness, 0.99) << "it is seen while it is pushed";
        EXPECT_GE(typography::clearance(window.rectangle.corners(), square(desk.prop_m, 0.08, 0.0)), 0.0125);
        EXPECT_GE(glm::dot(window.rectangle.centre_m, along), last);
        EXPECT_EQ(window.comings, 1U) << "it shows what it showed";
        last = glm::dot(window.rectangle.centre_m, along);
    }
    EXPECT_GT(last, glm::dot(at, along) + 0.05);
    while (glm::dot(desk.prop_m, along) < 0.45) {
        desk.slide(desk.prop_m + 0.01 * along);
    }
    desk.run(seconds(1));
    EXPECT_TRUE(desk.windows().empty()) << "it was put away";
}

TEST(WindowDesk, PushedWindowPushesTheNext) {
    Desk desk;
    desk.prop_m = {-0.3, 0.0};
    desk.run(milliseconds(100));
    desk.run(seconds(1), true);
    desk.run(seconds(1), true);
    ASSERT_EQ(desk.lit().size(), 2U);
    const double first = std::max(desk.lit()[0].rectangle.centre_m.x, desk.lit()[1].rectangle.centre_m.x);
    desk.slide({-0.1, 0.0});
    ASSERT_EQ(desk.lit().size(), 2U);
    EXPECT_GT(std::max(desk.lit()[0].rectangle.centre_m.x, desk.lit()[1].rectangle.centre_m.x), first + 0.05);
    EXPECT_GT(typography::clearance(desk.lit()[0].rectangle.corners(), desk.lit()[1].rectangle.corners()),
              0.006);
    for (const PresentedWindow& window : desk.lit()) {
        EXPECT_GT(window.brightness, 0.99);
    }
}

TEST(WindowDesk, WindowUnderThePropMovesElsewhere) {
    Desk desk;
    desk.run(milliseconds(100));
    desk.run(seconds(1), true);
    const glm::dvec2 at = desk.windows()[0].rectangle.centre_m;
    desk.stands = false; // lifted
    desk.prop_m = at;
    desk.step();
    EXPECT_TRUE(desk.lit().empty());
    desk.stands = true; // put down: not pushed aside by the half of its width
    desk.step();
    EXPECT_TRUE(desk.lit().empty());
    desk.run(milliseconds(800));
    EXPECT_TRUE(desk.lit().empty());
    desk.run(seconds(2));
    ASSERT_EQ(desk.lit().size(), 1U);
    EXPECT_EQ(desk.lit()[0].brightness, 1.0);
    EXPECT_EQ(desk.lit()[0].comings, 2U);
    EXPECT_GT(glm::distance(desk.lit()[0].rectangle.centre_m, at), 0.1);
}

TEST(WindowDesk, WindowMovesAwayFromANewCaption) {
    Desk desk;
    desk.run(milliseconds(100));
    desk.run(seconds(1), true);
    desk.obstacles = {{desk.windows()[0].rectangle.centre_m, {0.05, 0.02}, 0}};
    desk.step();
    EXPECT_TRUE(desk.lit().empty());
    desk.run(seconds(3));
    ASSERT_EQ(desk.lit().size(), 1U);
    EXPECT_GT(typography::clearance(desk.lit()[0].rectangle.corners(), desk.obstacles[0].corners()),
              WindowDesk::beside_m);
}

TEST(WindowDesk, TurnsToTheReadersSideInTheDark) {
    Desk desk;
    desk.run(milliseconds(100));
    desk.run(seconds(1), true);
    desk.side = 1;
    desk.eye_m = {0.7, 0.0, 0.5};
    double darkest = 1.0;
    for (int k = 0; k < 75; ++k) {
        desk.step();
        const PresentedWindow& window = desk.windows()[0];
        EXPECT_TRUE(window.brightness <= 0.0 ||
                    window.rectangle.quarter_turns == (window.comings == 1 ? 0 : 1));
        darkest = std::min(darkest, window.brightness);
    }
    EXPECT_EQ(darkest, 0.0);
    EXPECT_EQ(desk.windows()[0].brightness, 1.0);
    EXPECT_EQ(desk.windows()[0].rectangle.quarter_turns, 1);
}

TEST(WindowDesk, ReplacesTheOldestWithoutRoomAndThenPinsNothing) {
    Desk desk;
    desk.run(milliseconds(100));
    desk.run(seconds(1), true);
    ASSERT_EQ(desk.lit().size(), 1U);
    // A picture beside each place, but for the window's own.
    const TableRectangle own = desk.windows()[0].rectangle;
    for (double x = -0.38; x < 0.4; x += 0.06) {
        for (double y = -0.22; y < 0.24; y += 0.06) {
            const TableRectangle picture{{x, y}, {0.02, 0.02}, 0};
            if (typography::clearance(picture.corners(), own.corners()) > 0.02) {
                desk.obstacles.push_back(picture);
            }
        }
    }
    desk.run(seconds(3), true);
    ASSERT_EQ(desk.lit().size(), 1U);
    EXPECT_EQ(desk.lit()[0].number, 2U);
    EXPECT_LT(glm::distance(desk.lit()[0].rectangle.centre_m, own.centre_m), 0.03);
    desk.obstacles.push_back({{0.0, 0.0}, {0.8, 0.5}, 0});
    desk.run(seconds(8));
    EXPECT_TRUE(desk.windows().empty());
    desk.run(seconds(6), true);
    EXPECT_TRUE(desk.windows().empty());
    EXPECT_TRUE(desk.desk.can_pin());
}

TEST(WindowDesk, FadesAllWindowsOutWithoutAVisitor) {
    Desk desk;
    desk.run(milliseconds(100));
    desk.run(seconds(1), true);
    desk.run(seconds(1), true);
    desk.gone = true;
    double before = 1.0;
    for (int k = 0; k < 24; ++k) {
        desk.step();
        ASSERT_EQ(desk.lit().size(), 2U);
        EXPECT_LE(before - desk.lit()[0].brightness, 1.5 * to_seconds(frame) / WindowDesk::goes_s + 1e-9);
        before = desk.lit()[0].brightness;
    }
    desk.run(milliseconds(100));
    EXPECT_TRUE(desk.windows().empty());
    desk.step(true);
    EXPECT_TRUE(desk.windows().empty());
}

TEST(WindowDesk, RemovesWindowsOfADroppedArtifact) {
    Desk desk;
    desk.run(milliseconds(100));
    desk.run(seconds(1), true);
    desk.artifact = 1;
    desk.run(seconds(1), true);
    desk.desk.drop_artifact(0);
    desk.run(seconds(1));
    ASSERT_EQ(desk.windows().size(), 1U);
    EXPECT_EQ(desk.windows()[0].artifact, 1U);
}

TEST(WindowDesk, AllocatesNothing) {
    Desk desk(settings::max_windows);
    desk.run(seconds(1), true);
    const long before = synthetic::allocations_so_far();
    for (int k = 0; k < 600; ++k) {
        desk.side = k / 200;
        desk.prop_m.x = 0.2 * std::sin(0.02 * k);
        desk.step(k % 40 == 0);
    }
    EXPECT_EQ(synthetic::allocations_so_far(), before);
    EXPECT_GE(desk.windows().size(), 3U);
}

/// The windows that a place of the table shows, whatever is pressed with a prop at rest.
TEST(WindowDesk, FlashesAtMostTwicePerSecond) {
    int most = 0;
    for (unsigned seed = 0; seed < 24; ++seed) {
        bench::Seeded random(seed);
        Desk desk(1 + seed % settings::max_windows);
        std::map<std::pair<int, int>, std::vector<Luminance>> places;
        const double often = random.between(0.005, 0.5);
        for (int k = 0; k < 1500; ++k) {
            desk.artifact = static_cast<std::size_t>(random.between(0.0, 2.999));
            desk.step(random.happens(often));
            for (int x = -7; x <= 7; ++x) {
                for (int y = -4; y <= 4; ++y) {
                    const glm::dvec2 at(0.05 * x, 0.05 * y);
                    double light = 0.0;
                    for (const PresentedWindow& window : desk.windows()) {
                        light = lies_in(at, window.rectangle.corners()) ? std::max(light, window.brightness)
                                                                        : light;
                    }
                    places[{x, y}].push_back({desk.now, light});
                }
            }
        }
        for (const auto& [place, samples] : places) {
            most = std::max(most, max_flashes_per_second(samples));
        }
    }
    EXPECT_LE(most, 2);
    EXPECT_GE(most, 1) << "nothing was seen of the presses";
}

} // namespace
} // namespace frustumscreen::exhibit
