// States of an artifact as windows side by side, and the lens through which the prop turns and scales the newest one.
#include "app/exhibit/window_history.h"
#include "app/exhibit/window_lens.h"
#include "app/tracking/pose_math.h"
#include "app/typography/visitor_side.h"
#include "tests/exhibit/walked_exhibit.h"
#include "tests/render/counted_new.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

namespace frustumscreen::exhibit {
namespace {

using settings::Command;
using std::chrono::milliseconds;
using std::chrono::seconds;

constexpr Nanoseconds tick = milliseconds(20);
const glm::dvec3 vertical(0.0, 0.0, 1.0);

geometry::RigidTransform turned_by(double degrees, const glm::dvec3& at) {
    return {glm::angleAxis(glm::radians(degrees), vertical), at};
}

TEST(WindowHistory, PinsTheSeenViewThenEachStateOfIt) {
    WindowHistory history;
    const ViewToPin seen{std::nullopt, {0.0, -0.6, 0.5}, turned_by(10.0, {0.1, 0.0, 0.0})};
    ViewToPin later{std::nullopt, {0.1, -0.5, 0.5}, turned_by(13.0, {0.105, 0.0, 0.0})}; // a little farther
    std::vector<std::optional<std::size_t>> states;
    for (int press = 0; press < 5; ++press) {
        const ViewToPin& now = press == 0 ? seen : later;
        const ViewToPin view = history.next(7, 2, now);
        states.push_back(view.state);
        if (view.state) {
            const ViewToPin& first = press < 3 ? seen : later;
            EXPECT_EQ(view.eye_m, first.eye_m);
            EXPECT_EQ(view.table_from_prop.translation, first.table_from_prop.translation);
        }
        history.note(7, view);
    }
    EXPECT_EQ(states, (std::vector<std::optional<std::size_t>>{std::nullopt, 0, 1, std::nullopt, 0}))
        << "after the last state it begins anew";
    later.table_from_prop.translation.x += 0.011;
    EXPECT_FALSE(history.next(7, 2, later).state) << "the prop has moved";
    later.table_from_prop = turned_by(20.0, {0.1, 0.0, 0.0});
    EXPECT_FALSE(history.next(7, 2, later).state) << "the prop has turned";
    EXPECT_FALSE(history.next(6, 2, seen).state) << "another artifact";
    EXPECT_FALSE(history.next(7, 0, seen).state) << "there are no states";
    history.forget();
    EXPECT_FALSE(history.next(7, 2, seen).state);
}

/// Steps with one pose until the content has followed, less than the time after which a still prop ends it.
WindowLens::View after(WindowLens& lens, MonotonicTime& now, const geometry::RigidTransform& pose,
                       int side = 0) {
    for (int k = 0; k < 60; ++k) {
        now += tick;
        lens.step(now, pose, side);
    }
    return lens.view();
}

TEST(WindowLens, ContentTurnsWithThePropBeyondAFullTurn) {
    WindowLens lens;
    MonotonicTime now = sample::start;
    lens.begin(now, {0.5, 1.0}, turned_by(170.0, {}));
    WindowLens::View view;
    for (int degrees = 170; degrees <= 170 + 400; degrees += 20) {
        view = after(lens, now, turned_by(degrees, {}));
    }
    EXPECT_NEAR(view.turn_rad, 0.5 + glm::radians(400.0), 1e-3);
    EXPECT_NEAR(view.zoom, 1.0, 1e-9);
}

TEST(WindowLens, LiftingOrApproachingZoomsWithinLimits) {
    struct Row {
        glm::dvec3 way;
        int side = 0;
        double zoom = 1.0;
    };
    for (const Row& row :
         {Row{{0.0, 0.0, WindowLens::doubles_m}, 0, 2.0}, Row{{0.0, -WindowLens::doubles_m, 0.0}, 0, 2.0},
          Row{{0.0, 0.5 * WindowLens::doubles_m, 0.0}, 0, std::sqrt(0.5)}, Row{{0.3, 0.0, 0.0}, 0, 1.0},
          Row{{0.0, 0.0, 1.0}, 0, WindowLens::max_zoom}, Row{{0.0, 1.0, 0.0}, 0, WindowLens::min_zoom},
          Row{{0.0, WindowLens::doubles_m, 0.0}, 2, 2.0}}) { // for a reader on the far side
        WindowLens lens;
        MonotonicTime now = sample::start;
        lens.begin(now, {}, {});
        EXPECT_NEAR(after(lens, now, turned_by(0.0, row.way), row.side).zoom, row.zoom, 1e-3 * row.zoom);
        EXPECT_TRUE(lens.on());
    }
}

TEST(WindowLens, EndsWhenThePropRestsOrNeverMoves) {
    const auto on_for = [](bool moves) {
        WindowLens lens;
        const MonotonicTime begin = sample::start;
        MonotonicTime now = begin;
        lens.begin(now, {}, {});
        while (lens.on() && now - begin < seconds(60)) {
            now += tick;
            lens.step(now, moves ? turned_by(20.0, {}) : geometry::RigidTransform{}, 0);
        }
        return now - begin;
    };
    EXPECT_EQ(on_for(true), WindowLens::still + tick);
    EXPECT_EQ(on_for(false), WindowLens::waits);
}

/// The exhibit with an artifact that has two states.
class StatesExhibit : public ::testing::Test {
protected:
    static constexpr std::size_t states = 2;
    static Catalogue catalogue() {
        Catalogue all = walked::walked_catalogue();
        for (CatalogueEntry& entry : all) {
            entry.state_title_sizes_m = {{{0.05, 0.010}, {0.09, 0.008}, {0.04, 0.012}},
                                         {{0.06, 0.010}, {0.05, 0.008}, {0.04, 0.0}}};
        }
        return all;
    }
    static ExhibitPlace place(bool live = false) {
        ExhibitPlace place = walked::walked_place();
        place.table_pictures = false;
        place.windows = {.count = 4, .size_m = {0.08, 0.08}, .live = live};
        return place;
    }
    Presentation run(Nanoseconds time, std::vector<Command> commands = {}) {
        Presentation shown;
        const MonotonicTime end = now + time;
        do {
            now += tick;
            state.time = now;
            shown = exhibit.step(now, commands, state);
            commands.clear();
        } while (now < end);
        return shown;
    }
    void SetUp() override { (void)run(seconds(3), {Command::Help}); }

    MonotonicTime now = sample::start;
    tracking::TrackedState state = sample::tracked_state(sample::start);
    Exhibit exhibit{catalogue(), place(), "en", sample::start};
};

TEST_F(StatesExhibit, FurtherPressesPinTitledStates) {
    const glm::dvec3 eye = state.eye_m;
    (void)run(seconds(2), {Command::Window});
    state.eye_m.x += 0.1;
    (void)run(seconds(2), {Command::Window});
    const Presentation shown = run(seconds(2), {Command::Window});
    const auto windows = shown.windows.windows();
    ASSERT_EQ(windows.size(), 3U);
    for (std::size_t k = 0; k < 3; ++k) {
        const PresentedWindow& window = windows[k];
        EXPECT_EQ(window.state, k == 0 ? std::nullopt : std::optional(k - 1));
        EXPECT_EQ(window.eye_m, eye) << "the same view";
        EXPECT_EQ(window.brightness, 1.0);
        EXPECT_EQ(window.rectangle.size_m, windows[0].rectangle.size_m) << "so that they compare";
        if (k == 0) {
            EXPECT_EQ(window.title.size_m.y, 0.0);
            continue;
        }
        EXPECT_EQ(window.title.size_m, catalogue()[0].state_title_sizes_m[k - 1][0]);
        const glm::dvec2 down = typography::turned(window.title.centre_m - window.rectangle.centre_m,
                                                   -window.rectangle.quarter_turns);
        EXPECT_NEAR(down.x, 0.0, 1e-12);
        EXPECT_NEAR(down.y,
                    -0.5 * window.rectangle.size_m.y - WindowDesk::title_gap_m - 0.5 * window.title.size_m.y,
                    1e-12);
        for (const PresentedWindow& other : windows) {
            if (other.number != window.number) {
                EXPECT_GE(typography::clearance(window.title.corners(), other.rectangle.corners()), 0.0);
                EXPECT_GT(typography::clearance(window.title.corners(), other.rectangle.corners()), 0.0);
            }
        }
    }
    EXPECT_FALSE(run(seconds(2), {Command::Window}).windows.windows().back().state) << "begins anew";
}

TEST_F(StatesExhibit, HidesATitleMissingInTheLanguage) {
    (void)run(seconds(2), {Command::Window});
    (void)run(seconds(2), {Command::Window});
    (void)run(seconds(2), {Command::Window});
    (void)run(seconds(2), {Command::NextLanguage});
    const Presentation shown = run(seconds(2), {Command::NextLanguage});
    ASSERT_EQ(shown.language, "ar");
    EXPECT_EQ(shown.windows.windows()[1].title.size_m, glm::dvec2(0.04, 0.012));
    EXPECT_EQ(shown.windows.windows()[1].language, 2U);
    EXPECT_EQ(shown.windows.windows()[2].title.size_m.y, 0.0);
}

TEST_F(StatesExhibit, MovingThePropStartsANewHistory) {
    (void)run(seconds(2), {Command::Window});
    state.table_from_prop.translation.x -= 0.02;
    EXPECT_FALSE(run(seconds(2), {Command::Window}).windows.windows().back().state);
}

TEST_F(StatesExhibit, HeldButtonTurnsTheNewestWindowWithTheProp) {
    (void)run(seconds(2), {Command::Window});
    Presentation shown = run(seconds(2), {Command::Window});
    const std::uint32_t comings = shown.windows.windows()[1].comings;
    (void)run(milliseconds(40), {Command::HoldWindow});
    state.table_from_prop.rotation = glm::angleAxis(0.7, vertical) * state.table_from_prop.rotation;
    shown = run(milliseconds(800));
    EXPECT_TRUE(shown.windows.windows()[1].follows);
    EXPECT_FALSE(shown.windows.windows()[0].follows);
    EXPECT_NEAR(shown.windows.windows()[1].turn_rad, 0.7, 0.01);
    EXPECT_EQ(shown.windows.windows()[1].comings, comings);
    EXPECT_FALSE(shown.settled);
    shown = run(seconds(2));
    EXPECT_FALSE(shown.windows.windows()[1].follows);
    EXPECT_EQ(shown.windows.windows()[1].comings, comings + 1) << "it is frozen so";
    state.table_from_prop.rotation = glm::angleAxis(0.7, vertical) * state.table_from_prop.rotation;
    EXPECT_NEAR(run(seconds(1)).windows.windows()[1].turn_rad, 0.7, 1e-3) << "and stays so";
    EXPECT_EQ(shown.windows.windows()[0].turn_rad, 0.0);
}

TEST_F(StatesExhibit, PressEndsTheLens) {
    (void)run(seconds(2), {Command::Window});
    EXPECT_TRUE(run(milliseconds(40), {Command::HoldWindow}).windows.windows()[0].follows);
    EXPECT_FALSE(run(milliseconds(40), {Command::NextLanguage}).windows.windows()[0].follows);
}

TEST_F(StatesExhibit, OnlyTheWindowOfTheShownStateIsLive) {
    exhibit = Exhibit{catalogue(), place(true), "en", now};
    (void)run(seconds(3), {Command::Help});
    (void)run(seconds(2), {Command::Window});
    const Presentation shown = run(seconds(2), {Command::Window});
    EXPECT_TRUE(shown.windows.windows()[0].live);
    EXPECT_FALSE(shown.windows.windows()[1].live);
}

TEST_F(StatesExhibit, PressAndLensAllocateNothing) {
    (void)run(seconds(2), {Command::Window});
    const std::vector<Command> press{Command::Window}, hold{Command::HoldWindow};
    const long before = synthetic::allocations_so_far();
    now += tick;
    state.time = now;
    (void)exhibit.step(now, press, state);
    now += tick;
    state.time = now;
    (void)exhibit.step(now, hold, state);
    for (int k = 0; k < 50; ++k) {
        now += tick;
        state.time = now;
        (void)exhibit.step(now, {}, state);
    }
    if (synthetic::allocations_are_counted) {
        EXPECT_EQ(synthetic::allocations_so_far(), before);
    }
}

} // namespace
} // namespace frustumscreen::exhibit
