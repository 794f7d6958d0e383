#include "firmware_host/panel/buttons.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

namespace frustumscreen::panel {
namespace {

using std::chrono::milliseconds;
using std::chrono::minutes;
using std::chrono::seconds;
constexpr MonotonicTime start{seconds(50)};

/// Three buttons, sampled every millisecond.
class Fingers {
public:
    explicit Fingers(const ButtonTimes& times = {}) : buttons_(3, times) { run(milliseconds(1)); }

    void set(int button, bool down) { levels_.at(static_cast<std::size_t>(button)) = down; }
    void run(Nanoseconds length) {
        for (const MonotonicTime end = now_ + length; now_ < end; now_ += milliseconds(1)) {
            buttons_.sample(now_, levels_, events);
        }
    }
    void press(int button, Nanoseconds length) {
        set(button, true);
        run(length);
        set(button, false);
        run(milliseconds(100));
    }
    [[nodiscard]] MonotonicTime now() const { return now_; }
    [[nodiscard]] bool chord_held() const { return buttons_.chord_held(); }
    [[nodiscard]] int count(PressKind kind) const {
        int found = 0;
        for (const PanelEvent& event : events) {
            found += event.kind == kind ? 1 : 0;
        }
        return found;
    }

    std::vector<PanelEvent> events;

private:
    Buttons buttons_;
    MonotonicTime now_ = start;
    std::array<bool, 3> levels_{};
};

TEST(Buttons, ReportsAPressOnceWithItsBeginTime) {
    Fingers fingers;
    const MonotonicTime began = fingers.now();
    fingers.press(1, milliseconds(200));
    ASSERT_EQ(fingers.events.size(), 1U);
    EXPECT_EQ(fingers.events[0].time, began);
    EXPECT_EQ(fingers.events[0].button, 1);
    EXPECT_EQ(fingers.events[0].kind, PressKind::Press);
}

TEST(Buttons, IgnoresBouncingContacts) {
    std::mt19937 engine(1);
    Fingers fingers;
    for (int press = 0; press < 50; ++press) {
        for (const bool down : {true, false}) {
            for (int bounce = 0; bounce < 12; ++bounce) { // for at most 24 ms, less than the debounce time
                fingers.set(0, (engine() & 1U) != 0);
                fingers.run(milliseconds(1 + engine() % 2));
            }
            fingers.set(0, down);
            fingers.run(milliseconds(300));
        }
    }
    EXPECT_EQ(fingers.count(PressKind::Press), 50);
    EXPECT_EQ(fingers.events.size(), 50U);
}

TEST(Buttons, IgnoresGlitchesShorterThanTheDebounceTime) {
    Fingers fingers;
    for (int k = 0; k < 100; ++k) {
        fingers.press(2, milliseconds(29));
        fingers.run(milliseconds(200));
    }
    EXPECT_TRUE(fingers.events.empty());
}

TEST(Buttons, ReportsOneLongPressAfterItsPress) {
    Fingers fingers;
    const MonotonicTime began = fingers.now();
    fingers.press(0, seconds(5));
    ASSERT_EQ(fingers.events.size(), 2U);
    EXPECT_EQ(fingers.events[1].kind, PressKind::LongPress);
    EXPECT_EQ(fingers.events[1].time, began + milliseconds(1500));
    fingers.press(0, milliseconds(100));
    EXPECT_EQ(fingers.count(PressKind::Press), 2);
}

TEST(Buttons, FirstAndLastButtonMakeAChordAndNoLongPress) {
    Fingers fingers;
    fingers.set(0, true);
    fingers.run(milliseconds(700));
    fingers.set(2, true);
    const MonotonicTime both = fingers.now();
    fingers.run(seconds(6));
    EXPECT_EQ(fingers.count(PressKind::Chord), 1);
    EXPECT_EQ(fingers.count(PressKind::LongPress), 0);
    EXPECT_EQ(fingers.events.back().time, both + seconds(3));
    fingers.set(0, false);
    fingers.set(2, false);
    fingers.run(milliseconds(100));
    fingers.set(0, true);
    fingers.set(2, true);
    fingers.run(seconds(4));
    EXPECT_EQ(fingers.count(PressKind::Chord), 2);
}

/// The chord is not an event but a state of the two buttons; it ends with the level, before any debouncing.
TEST(Buttons, ChordIsHeldUntilOneOfItsButtonsIsReleased) {
    Fingers fingers;
    fingers.set(0, true);
    fingers.set(1, true);
    fingers.run(seconds(1));
    EXPECT_FALSE(fingers.chord_held());
    fingers.set(2, true);
    fingers.run(milliseconds(10));
    EXPECT_FALSE(fingers.chord_held()) << "it may be a glitch";
    fingers.run(milliseconds(40));
    EXPECT_TRUE(fingers.chord_held());
    fingers.run(seconds(20));
    EXPECT_TRUE(fingers.chord_held());
    fingers.set(1, false);
    fingers.run(milliseconds(100));
    EXPECT_TRUE(fingers.chord_held()) << "the others are none of it";
    fingers.set(0, false);
    fingers.run(milliseconds(1));
    EXPECT_FALSE(fingers.chord_held());
    fingers.run(seconds(1));
    EXPECT_FALSE(fingers.chord_held());
}

TEST(Buttons, StuckButtonsEndTheChord) {
    Fingers fingers;
    fingers.set(0, true);
    fingers.set(2, true);
    fingers.run(ButtonTimes().stuck - milliseconds(100));
    EXPECT_TRUE(fingers.chord_held());
    fingers.run(milliseconds(200));
    EXPECT_FALSE(fingers.chord_held());
}

/// Every millisecond: no button waits for more than the debounce time, regardless of the others.
TEST(Buttons, ReportsAPressAtOnceEvenIfItMayBecomeAChord) {
    for (int apart_ms = 0; apart_ms < 3000; apart_ms += 47) {
        Fingers fingers;
        fingers.set(0, true);
        fingers.run(milliseconds(apart_ms));
        fingers.set(2, true);
        const MonotonicTime second = fingers.now();
        fingers.run(milliseconds(31));
        ASSERT_EQ(fingers.count(PressKind::Press), 2) << apart_ms;
        EXPECT_EQ(fingers.events.back().time, second);
        EXPECT_EQ(fingers.events.back().button, 2);
    }
}

/// A consumer that acted on these two presses must know what to undo.
TEST(Buttons, ChordIsTimedFromTheLatestPressOfItsButtons) {
    std::mt19937 engine(11);
    int chords = 0;
    for (int run = 0; run < 20; ++run) {
        Fingers fingers;
        for (int k = 0; k < 60; ++k) {
            fingers.set(static_cast<int>(engine() % 3), engine() % 3 != 0);
            fingers.run(milliseconds(engine() % 2 == 0 ? engine() % 200 : engine() % 6000));
        }
        std::array<std::optional<MonotonicTime>, 3> pressed;
        for (const PanelEvent& event : fingers.events) {
            if (event.kind == PressKind::Press) {
                pressed.at(static_cast<std::size_t>(event.button)) = event.time;
            } else if (event.kind == PressKind::Chord) {
                ASSERT_TRUE(pressed[0] && pressed[2]);
                EXPECT_EQ(std::max(*pressed[0], *pressed[2]) + seconds(3), event.time);
                ++chords;
            }
        }
    }
    EXPECT_GT(chords, 20);
}

TEST(Buttons, ReportsAStuckButtonOnceAndIgnoresItUntilReleased) {
    Fingers fingers;
    fingers.set(1, true);
    fingers.run(seconds(40));
    EXPECT_EQ(fingers.count(PressKind::Press), 1);
    EXPECT_EQ(fingers.count(PressKind::Stuck), 1);
    fingers.press(0, milliseconds(100)); // the others continue to work
    EXPECT_EQ(fingers.count(PressKind::Press), 2);
    fingers.set(1, false);
    fingers.run(milliseconds(100));
    EXPECT_EQ(fingers.count(PressKind::Freed), 1);
    fingers.press(1, milliseconds(100));
    EXPECT_EQ(fingers.count(PressKind::Press), 3);
}

TEST(Buttons, ButtonDownAtTheStartIsNoPress) {
    Buttons buttons(3, {});
    std::vector<PanelEvent> events;
    const std::array<bool, 3> held{true, false, false};
    for (int k = 0; k < 20'000; ++k) {
        buttons.sample(start + milliseconds(k), held, events);
    }
    EXPECT_TRUE(events.empty());
    for (int k = 20'000; k < 40'000; ++k) {
        buttons.sample(start + milliseconds(k), held, events);
    }
    ASSERT_EQ(events.size(), 1U);
    EXPECT_EQ(events[0].kind, PressKind::Stuck);
    EXPECT_TRUE(buttons.any_stuck());
}

/// A wrong `active_low` or bias, or shorted wires: every button is down from the first sample on.
TEST(Buttons, ButtonsDownAtTheStartMakeNoChordUntilReleased) {
    for (const std::array<bool, 3> held :
         {std::array{true, true, true}, std::array{true, false, false}, std::array{false, false, true}}) {
        Buttons buttons(3, {});
        std::vector<PanelEvent> events;
        int ms = 0;
        const auto hold = [&](const std::array<bool, 3>& levels, int until_ms) {
            for (; ms < until_ms; ++ms) {
                buttons.sample(start + milliseconds(ms), levels, events);
            }
        };
        const auto chords = [&] {
            return std::count_if(events.begin(), events.end(),
                                 [](const PanelEvent& event) { return event.kind == PressKind::Chord; });
        };
        hold(held, 100);
        hold({true, true, true}, 10'000);
        EXPECT_EQ(chords(), 0);
        hold({}, 10'100);
        hold({true, false, true}, 13'000);
        EXPECT_EQ(chords(), 0);
        hold({true, false, true}, 13'200);
        EXPECT_EQ(chords(), 1);
    }
}

/// Sampled like in the panel's thread: every 20 ms, sometimes slightly late, and when a deadline is due.
class LooseContact {
public:
    explicit LooseContact(unsigned seed, double closed = 0.5) : random_(seed), closed_(closed) {}

    /// The first button's contact opens and closes 5000 times a second, or stays open; the last button is
    /// pressed and released once a second.
    void run(Nanoseconds length, bool chatters) {
        for (const MonotonicTime end = now_ + length; now_ < end;) {
            const double phase = std::fmod(5000.0 * to_seconds(now_ - start), 1.0);
            const std::array<bool, 3> levels{chatters && phase < closed_, false,
                                             (now_ - start) / milliseconds(500) % 2 == 1};
            buttons_.sample(now_, levels, events_);
            MonotonicTime next = now_ + milliseconds(20);
            if (const auto due = buttons_.due()) {
                next = std::min(next, std::max(now_, *due));
            }
            now_ = next + std::chrono::microseconds(random_() % 1000);
        }
    }
    [[nodiscard]] int count(int button, PressKind kind) const {
        return static_cast<int>(std::count_if(events_.begin(), events_.end(), [&](const PanelEvent& event) {
            return event.button == button && event.kind == kind;
        }));
    }
    [[nodiscard]] const Buttons& buttons() const { return buttons_; }
    [[nodiscard]] const std::vector<PanelEvent>& events() const { return events_; }

private:
    std::mt19937 random_;
    double closed_;
    Buttons buttons_{3, {}};
    MonotonicTime now_ = start;
    std::vector<PanelEvent> events_;
};

TEST(Buttons, IgnoresALooseContactUntilItIsQuiet) {
    for (unsigned seed = 0; seed < 40; ++seed) {
        LooseContact contact(seed, 0.1 + 0.02 * seed); // closed for a tenth up to nine tenths of the time
        contact.run(seconds(12), true);
        EXPECT_EQ(contact.count(0, PressKind::Chatters), 1) << seed;
        const int presses = contact.count(0, PressKind::Press);
        EXPECT_LE(presses, 20);
        EXPECT_TRUE(contact.buttons().ignored(0) && contact.buttons().any_chatters());
        EXPECT_FALSE(contact.buttons().ignored(2));
        contact.run(minutes(10) - seconds(12), true);
        EXPECT_EQ(contact.count(0, PressKind::Press), presses) << "never again";
        EXPECT_EQ(contact.count(0, PressKind::Freed), 0);
        EXPECT_EQ(contact.count(0, PressKind::Stuck), 0);
        EXPECT_EQ(contact.count(2, PressKind::Press), 10 * 60) << "the others go on";
        contact.run(seconds(4), false);
        EXPECT_EQ(contact.count(0, PressKind::Freed), 1);
        EXPECT_FALSE(contact.buttons().ignored(0));
    }
}

TEST(Buttons, FortyEdgesWithinTenSecondsAreChatter) {
    for (const bool too_fast : {false, true}) {
        Fingers fingers;
        const MonotonicTime began = fingers.now();
        for (int k = 0; k < 19; ++k) {
            fingers.set(1, true);
            fingers.run(milliseconds(100));
            fingers.set(1, false);
            fingers.run(milliseconds(400));
        }
        fingers.set(1, true);
        fingers.run(milliseconds(too_fast ? 500 : 501));
        fingers.set(1, false);
        fingers.run(milliseconds(100));
        EXPECT_EQ(fingers.count(PressKind::Press), 20);
        ASSERT_EQ(fingers.count(PressKind::Chatters), too_fast ? 1 : 0);
        if (too_fast) {
            EXPECT_EQ(fingers.events.back().time, began + seconds(10));
        }
    }
}

TEST(Buttons, IgnoresHammeringUntilThreeSecondsAfterRelease) {
    Fingers fingers;
    MonotonicTime let_go;
    for (int k = 0; k < 70; ++k) { // seven times a second, for ten seconds
        fingers.set(0, true);
        fingers.run(milliseconds(60));
        fingers.set(0, false);
        let_go = fingers.now();
        fingers.run(milliseconds(83));
    }
    EXPECT_EQ(fingers.count(PressKind::Press), 20);
    EXPECT_EQ(fingers.count(PressKind::Chatters), 1);
    fingers.press(1, milliseconds(100)); // the others continue to work
    EXPECT_EQ(fingers.count(PressKind::Press), 21);
    fingers.run(seconds(3));
    ASSERT_EQ(fingers.count(PressKind::Freed), 1);
    EXPECT_EQ(fingers.events.back().time, let_go + seconds(3));
    fingers.press(0, milliseconds(100));
    EXPECT_EQ(fingers.count(PressKind::Press), 22) << "its old presses are forgotten";
    EXPECT_EQ(fingers.count(PressKind::Chatters), 1);
}

TEST(Buttons, FrequentRegularPressesAreNoChatter) {
    Fingers fingers;
    for (int k = 0; k < 100; ++k) { // three in two seconds, continuously
        fingers.set(1, true);
        fingers.run(milliseconds(150));
        fingers.set(1, false);
        fingers.run(milliseconds(517));
    }
    EXPECT_EQ(fingers.count(PressKind::Press), 100);
    EXPECT_EQ(fingers.events.size(), 100U);
}

TEST(Buttons, ChatteringButtonMakesNoChordAndMayBecomeStuck) {
    Fingers fingers;
    const auto hammer = [&] {
        for (int k = 0; k < 40; ++k) {
            fingers.set(0, k % 2 == 0);
            fingers.run(milliseconds(50));
        }
    };
    hammer();
    ASSERT_EQ(fingers.count(PressKind::Chatters), 1);
    fingers.set(0, true);
    fingers.set(2, true);
    const MonotonicTime down = fingers.now();
    fingers.run(seconds(20));
    EXPECT_EQ(fingers.count(PressKind::Chord), 0);
    EXPECT_EQ(fingers.count(PressKind::Freed), 1) << "it is quiet";
    fingers.run(seconds(11));
    EXPECT_EQ(fingers.count(PressKind::Stuck), 2);
    EXPECT_EQ(fingers.events.back().time, down + seconds(30));
}

TEST(Buttons, AcceptsAnySamplingIntervalAndIgnoresOlderSamples) {
    Buttons buttons(3, {});
    std::vector<PanelEvent> events;
    const std::array<bool, 3> none{};
    const std::array<bool, 3> one{true, false, false};
    buttons.sample(start, none, events);
    buttons.sample(start + seconds(1), one, events);
    // A clock never goes back; a caller's mistake must do no harm.
    buttons.sample(start - seconds(5), none, events);
    buttons.sample(start + seconds(1), one, events);
    EXPECT_TRUE(events.empty());
    buttons.sample(start + seconds(1000), one, events); // after a long pause: everything that was due, in
                                                        // order
    ASSERT_EQ(events.size(), 3U);
    EXPECT_EQ(events[0].kind, PressKind::Press);
    EXPECT_EQ(events[1].kind, PressKind::LongPress);
    EXPECT_EQ(events[2].kind, PressKind::Stuck);
    EXPECT_FALSE(buttons.due());
}

TEST(Buttons, AReleaseDuringALateSampleIsNoLongPress) {
    const std::array<bool, 3> none{}, second{false, true, false}, outer{true, false, true};
    for (const std::array<bool, 3>& held : {second, outer}) {
        Buttons buttons(3, {});
        std::vector<PanelEvent> events;
        buttons.sample(start, none, events);
        buttons.sample(start + milliseconds(10), held, events);
        buttons.sample(start + milliseconds(40), held, events);
        const auto presses = static_cast<std::size_t>(std::count(held.begin(), held.end(), true));
        ASSERT_EQ(events.size(), presses);
        for (const int late_ms : {5000, 5010, 5030, 9000}) { // the button was released at any time before
            buttons.sample(start + milliseconds(late_ms), none, events);
        }
        EXPECT_EQ(events.size(), presses) << "more than its press";
        EXPECT_FALSE(buttons.due());
        // A bounce at the time of a long press only delays its report.
        buttons.sample(start + milliseconds(10'000), second, events);
        buttons.sample(start + milliseconds(10'100), second, events);
        buttons.sample(start + milliseconds(11'500), none, events);
        EXPECT_EQ(*buttons.due(), start + milliseconds(11'530));
        buttons.sample(start + milliseconds(11'505), second, events);
        ASSERT_EQ(events.size(), presses + 2);
        EXPECT_EQ(events.back().kind, PressKind::LongPress);
        EXPECT_EQ(events.back().time, start + milliseconds(11'500));
    }
}

TEST(Buttons, SamplingOnlyWhenDueEqualsConstantSampling) {
    std::mt19937 engine(7);
    for (int run = 0; run < 40; ++run) {
        std::vector<std::array<bool, 3>> levels; // every millisecond
        std::array<bool, 3> now{};
        while (levels.size() < 60'000) {
            now.at(engine() % 3) = (engine() & 1U) != 0;
            levels.insert(levels.end(), 1 + engine() % (run % 2 == 0 ? 100 : 6000), now);
        }
        Buttons always(3, {});
        Buttons seldom(3, {});
        std::vector<PanelEvent> expected;
        std::vector<PanelEvent> found;
        for (std::size_t k = 0; k < levels.size(); ++k) {
            const MonotonicTime time = start + milliseconds(k);
            always.sample(time, levels[k], expected);
            const bool changed = k == 0 || levels[k] != levels[k - 1];
            if (changed || (seldom.due() && *seldom.due() <= time)) {
                seldom.sample(time, levels[k], found);
            }
        }
        ASSERT_EQ(found.size(), expected.size()) << run;
        for (std::size_t k = 0; k < found.size(); ++k) {
            EXPECT_EQ(found[k].time, expected[k].time);
            EXPECT_EQ(found[k].button, expected[k].button);
            EXPECT_EQ(found[k].kind, expected[k].kind);
        }
    }
}

} // namespace
} // namespace frustumscreen::panel
