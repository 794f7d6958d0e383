// Windows in the whole exhibit: the button, rest, sets, and everything else that lies on the table; in simulated time.
#include "app/bench/truth/seeded_situations.h"
#include "app/tracking/pose_math.h"
#include "tests/exhibit/walked_exhibit.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <vector>

namespace frustumscreen::exhibit {
namespace {

using settings::Command;
using std::chrono::milliseconds;
using std::chrono::seconds;
using typography::TableRectangle;

constexpr Nanoseconds frame = milliseconds(20);
constexpr double seen = 0.01; ///< of the light

/// The whole exhibit, with everything else that lies on the table.
class WindowExhibit : public ::testing::Test {
protected:
    static ExhibitPlace place(std::size_t count, std::size_t buttons = 7) {
        ExhibitPlace place = walked::walked_place();
        for (AdviceLanguage& language : place.words) {
            language.texts.push_back({"pin_window", {{0.12, 0.02}}});
            language.texts.push_back({"turn_window", {{0.12, 0.02}}});
        }
        place.buttons = buttons;
        place.windows.reset();
        if (count > 0) {
            place.windows = {.count = count, .size_m = {0.08, 0.08}};
        }
        return place;
    }
    Presentation run(Nanoseconds time, std::vector<Command> commands = {}) {
        Presentation shown;
        const MonotonicTime end = now + time;
        do {
            now += frame;
            state.time = now;
            shown = exhibit.step(now, commands, state);
            commands.clear();
        } while (now < end);
        return shown;
    }
    [[nodiscard]] static bool lamp(const Presentation& shown) {
        return (shown.lamps & (1U << static_cast<unsigned>(settings::button_of(Command::Window)))) != 0;
    }
    void visit() {
        state = sample::tracked_state(now);
        (void)run(seconds(3), {Command::NextLanguage});
    }

    MonotonicTime now = sample::start;
    tracking::TrackedState state = sample::tracked_state(sample::start);
    Exhibit exhibit{walked::walked_catalogue(), place(3), "en", sample::start};
};

TEST_F(WindowExhibit, SeventhButtonPinsTheViewOfTheShownArtifact) {
    EXPECT_FALSE(lamp(run(seconds(1)))) << "nobody is there";
    visit();
    EXPECT_TRUE(lamp(run(milliseconds(20))));
    state.eye_m = {0.1, -0.6, 0.45};
    Presentation shown = run(seconds(1), {Command::Window});
    ASSERT_EQ(shown.windows.windows().size(), 1U);
    EXPECT_EQ(shown.windows.windows()[0].artifact, shown.artifact);
    EXPECT_EQ(shown.windows.windows()[0].eye_m, state.eye_m);
    EXPECT_EQ(shown.windows.windows()[0].brightness, 1.0);
    shown = run(seconds(3), {Command::NextArtifact});
    EXPECT_EQ(shown.windows.windows().size(), 1U) << "another artifact, and the window stays";
    EXPECT_NE(shown.windows.windows()[0].artifact, shown.artifact);
    const auto wanted = shown.wanted.artifacts();
    EXPECT_NE(std::find(wanted.begin(), wanted.end(), shown.windows.windows()[0].artifact), wanted.end());
}

TEST_F(WindowExhibit, RemovesAllWindowsAtRest) {
    visit();
    EXPECT_EQ(run(seconds(1), {Command::Window}).windows.windows().size(), 1U);
    const Presentation shown = run(seconds(400));
    EXPECT_EQ(shown.state, State::Attract);
    EXPECT_TRUE(shown.windows.windows().empty());
}

TEST_F(WindowExhibit, WindowsFadeOutWithTheirSet) {
    visit();
    (void)run(seconds(1), {Command::Window});
    exhibit.await_set(true);
    double before = 1.0;
    bool faded = false;
    for (int k = 0; k < 5000 && !exhibit.set_has_left(); ++k) {
        const Presentation shown = run(frame);
        for (const PresentedWindow& window : shown.windows.windows()) {
            EXPECT_LE(before - window.brightness, 1.5 * to_seconds(frame) / to_seconds(fade_time) + 1e-9)
                << "softly";
            before = window.brightness;
            faded = faded || (before > 0.1 && before < 0.9);
        }
    }
    EXPECT_TRUE(faded);
    (void)exhibit.show_set(walked::walked_catalogue(),
                           lay_out_catalogue(walked::walked_catalogue(), place(3)), place(3).words, 0, now);
    EXPECT_TRUE(run(seconds(1)).windows.windows().empty());
}

TEST_F(WindowExhibit, ButtonDoesNothingWhenWindowsAreDisabled) {
    exhibit = Exhibit{walked::walked_catalogue(), place(0), "en", now};
    visit();
    const Presentation shown = run(seconds(1), {Command::Window});
    EXPECT_TRUE(shown.windows.windows().empty());
    EXPECT_FALSE(lamp(shown));
}

TEST_F(WindowExhibit, ExplainsTheButtonOnceUnlessItWasPressed) {
    for (const bool finds : {false, true}) {
        exhibit = Exhibit{Catalogue(2, CatalogueEntry{walked::languages, {3, {{0.14, 0.04}}}}), place(3),
                          "en", now};
        visit();
        if (finds) {
            (void)run(frame, {Command::Window});
        }
        const auto text = static_cast<std::size_t>(walked::keys.size());
        double told_s = 0.0;
        for (int k = 0; k < 2000; ++k) {
            state.table_from_prop.translation.x = 0.03 * (k / 100 % 2); // somebody is there
            const Presentation shown = run(frame);
            told_s += shown.advice && shown.advice->word.text == text ? to_seconds(frame) : 0.0;
        }
        EXPECT_NEAR(told_s, finds ? 0.0 : 10.0, 0.6);
    }
}

TEST_F(WindowExhibit, ExplainsHoldingOnceUnlessTheButtonWasHeld) {
    for (const bool holds : {false, true}) {
        exhibit = Exhibit{Catalogue(2, CatalogueEntry{walked::languages, {3, {{0.14, 0.04}}}}), place(3),
                          "en", now};
        visit();
        (void)run(frame, {Command::Window});
        if (holds) {
            (void)run(frame, {Command::HoldWindow});
        }
        const auto text = static_cast<std::size_t>(walked::keys.size() + 1);
        double told_s = 0.0;
        for (int k = 0; k < 2000; ++k) {
            state.table_from_prop.translation.x = 0.03 * (k / 100 % 2); // somebody is there
            const Presentation shown = run(frame);
            told_s += shown.advice && shown.advice->word.text == text ? to_seconds(frame) : 0.0;
        }
        EXPECT_NEAR(told_s, holds ? 0.0 : 8.0, 0.6);
    }
}

/// The staff's chord is the first and the last button of the panel, six or seven.
TEST_F(WindowExhibit, ChordUndoesThePressOfTheLastButton) {
    for (const std::size_t buttons : {std::size_t{6}, std::size_t{7}}) {
        exhibit = Exhibit{walked::walked_catalogue(), place(3, buttons), "en", now};
        visit();
        const std::size_t before = exhibit.chosen();
        (void)run(frame, {settings::button_commands.at(buttons - 1)});
        (void)run(frame, {Command::PreviousArtifact});
        EXPECT_EQ(run(seconds(1)).windows.windows().size(), buttons - 6) << "the seventh button pins";
        (void)run(frame, {Command::StaffMode});
        EXPECT_EQ(exhibit.chosen(), before) << buttons;
        EXPECT_TRUE(run(seconds(1)).windows.windows().empty());
    }
}

bool overlap(const TableRectangle& a, const TableRectangle& b) {
    return typography::clearance(a.corners(), b.corners()) <= 0.0;
}

/// A hand slides, turns and lifts the prop and presses every button: no visible window overlaps anything else that is seen.
TEST_F(WindowExhibit, WindowsNeverOverlapAnythingOnTheTable) {
    const ExhibitPlace where = place(3);
    std::size_t most = 0;
    int pushed = 0, moved_on = 0;
    for (std::uint64_t seed = 1; seed <= 6; ++seed) {
        bench::Seeded random(seed);
        exhibit = Exhibit{walked::walked_catalogue(), where, "en", now};
        visit();
        glm::dvec2 to(0.0);
        std::map<std::uint32_t, PresentedWindow> before;
        for (int k = 0; k < 6000; ++k) {
            geometry::RigidTransform& pose = state.table_from_prop;
            if (random.happens(0.01)) {
                to = {random.between(-0.3, 0.3), random.between(-0.15, 0.15)};
            }
            if (random.happens(0.004)) {
                state.eye_m = random.happens(0.5) ? glm::dvec3(0.0, -0.55, 0.5) : glm::dvec3(0.7, 0.0, 0.5);
            }
            const glm::dvec2 off = to - glm::dvec2(pose.translation);
            const double step_m = 0.2 * to_seconds(frame);
            if (glm::length(off) > step_m) {
                pose.translation += glm::dvec3(step_m * glm::normalize(off), 0.0);
            }
            pose.translation.z = random.happens(0.995) ? pose.translation.z
                                 : random.happens(0.5) ? 0.06
                                                       : 0.0;
            pose.rotation =
                glm::normalize(pose.rotation * tracking::rotation_of({0.0, 0.0, 0.02 * random.normal()}));
            std::vector<Command> commands;
            if (random.happens(0.03)) {
                commands.push_back(
                    settings::button_commands.at(static_cast<std::size_t>(random.between(0.0, 6.999))));
            }
            if (random.happens(0.02)) {
                commands.push_back(Command::Window);
            }
            const Presentation shown = run(frame, commands);
            const auto shadow = typography::hidden_by_prop(where.prop, shown.table_from_prop, where.lens_m);
            std::vector<TableRectangle> lit;
            for (const PresentedWindow& window : shown.windows.windows()) {
                if (window.brightness > seen) {
                    lit.push_back(window.rectangle);
                }
                const auto found = before.find(window.number);
                const bool same = found != before.end() && found->second.comings == window.comings;
                pushed += same && found->second.rectangle.centre_m != window.rectangle.centre_m ? 1 : 0;
                moved_on += window.comings > 1 ? 1 : 0;
                const double last = found != before.end() ? found->second.brightness : 0.0;
                // The thing that covered it and a sign on it may leave at the same time.
                constexpr double fastest =
                    1.0 / 0.25 + 1.5 * (1.0 - WindowDesk::under_sign) / WindowDesk::under_sign_s;
                EXPECT_LE(window.brightness - last, fastest * to_seconds(frame)) << "it jumps into the light";
            }
            before.clear();
            for (const PresentedWindow& window : shown.windows.windows()) {
                before[window.number] = window;
            }
            most = std::max(most, lit.size());
            ASSERT_LE(lit.size(), 3U);
            for (std::size_t a = 0; a < lit.size(); ++a) {
                for (std::size_t b = 0; b < a; ++b) {
                    ASSERT_FALSE(overlap(lit[a], lit[b])) << seed << ": " << k;
                }
                ASSERT_TRUE(shadow);
                ASSERT_GT(typography::clearance(lit[a].corners(), shadow->corners()), 0.0)
                    << seed << ": " << k;
                ASSERT_FALSE(shown.caption && shown.caption->brightness > seen &&
                             overlap(lit[a], shown.caption->rectangle))
                    << seed << ": " << k;
                ASSERT_FALSE(shown.hotspot && overlap(lit[a], shown.hotspot->label)) << seed << ": " << k;
                ASSERT_FALSE(shown.title && overlap(lit[a], shown.title->rectangle)) << seed << ": " << k;
                ASSERT_FALSE(shown.advice && overlap(lit[a], shown.advice->rectangle)) << seed << ": " << k;
                for (const PlacedPicture& picture : shown.table->pictures()) {
                    ASSERT_FALSE(picture.brightness > seen && overlap(lit[a], picture.place.whole()))
                        << seed << ": " << k;
                }
            }
        }
    }
    EXPECT_EQ(most, 3U);
    EXPECT_GT(pushed, 100);
    EXPECT_GT(moved_on, 100);
}

} // namespace
} // namespace frustumscreen::exhibit
