// The exhibit's decisions, held against a table and against a model that only counts.

#include "tests/exhibit/exhibits.h"
#include "tests/render/counted_new.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <random>

namespace frustumscreen {
namespace {

using sample::situation;
using sample::start;
using std::chrono::milliseconds;
using std::chrono::seconds;

constexpr Nanoseconds rest = seconds(3); ///< all fades are over

/// What one command does, by the state that it meets.
struct Row {
    bool staff;
    Command command;
    bool staff_after;
    int artifact_step;
    int language_step;
};
constexpr std::array table{
    Row{false, Command::PreviousArtifact, false, -1, 0}, Row{false, Command::NextArtifact, false, 1, 0},
    Row{false, Command::NextLanguage, false, 0, 1},      Row{false, Command::StaffMode, true, 0, 0},
    Row{true, Command::PreviousArtifact, false, 0, 0},   Row{true, Command::NextArtifact, false, 0, 0},
    Row{true, Command::NextLanguage, false, 0, 0},       Row{true, Command::StaffMode, false, 0, 0},
};

const std::vector<std::string> languages{"en", "de", "fr"};

/// After as many frames as it takes until nothing fades: a caption appears from the frame on that places it.
Presentation settled(Exhibit& exhibit, MonotonicTime now) {
    const MonotonicTime end = now + rest;
    for (; now < end; now += milliseconds(50)) {
        static_cast<void>(exhibit.step(now, {}, situation(now)));
    }
    return exhibit.step(end, {}, situation(end));
}

TEST(Exhibit, EachCommandDoesWhatTheTableSays) {
    for (const Row& row : table) {
        Exhibit exhibit = sample::exhibit(4, languages);
        MonotonicTime now = start;
        if (row.staff) {
            const std::array chord{Command::StaffMode};
            EXPECT_TRUE(exhibit.step(now, chord, situation(now)).staff);
        }
        now += seconds(1);
        EXPECT_EQ(exhibit.step(now, std::span(&row.command, 1), situation(now)).staff, row.staff_after);
        const Presentation shown = settled(exhibit, now);
        EXPECT_EQ(shown.artifact, static_cast<std::size_t>(row.artifact_step + 4) % 4);
        EXPECT_EQ(shown.language, languages[static_cast<std::size_t>(row.language_step)]);
        ASSERT_TRUE(shown.caption);
        EXPECT_EQ(shown.caption->language, static_cast<std::size_t>(row.language_step));
        EXPECT_TRUE(shown.settled);
        EXPECT_EQ(shown.brightness, 1.0);
        EXPECT_EQ(shown.caption->brightness, 1.0);
    }
}

/// Every press that counts, by button. A chord strikes out the latest of the first and of the last button, if
/// that press reached the exhibit.
class Ledger {
public:
    explicit Ledger(std::size_t buttons) : buttons_(buttons) {}

    void press(std::size_t button) {
        latest_counts_[button] = !staff;
        counted_[button] += staff ? 0 : 1;
        staff = false;
    }
    void chord() {
        for (const std::size_t button : {std::size_t{0}, buttons_ - 1}) {
            counted_[button] -= latest_counts_[button] ? 1 : 0;
            latest_counts_[button] = false;
        }
        staff = !staff;
    }
    [[nodiscard]] std::size_t artifact(int count) const {
        return static_cast<std::size_t>(((counted_[1] - counted_[0]) % count + count) % count);
    }
    [[nodiscard]] std::size_t language(int count) const {
        return static_cast<std::size_t>(counted_[2] % count);
    }

    bool staff = false;

private:
    std::size_t buttons_;
    std::array<bool, 3> latest_counts_{};
    std::array<int, 3> counted_{};
};

TEST(Exhibit, EndsWhereAllThePressesLead) {
    for (unsigned seed = 0; seed < 300; ++seed) {
        std::mt19937 random(seed);
        const std::size_t buttons = 2 + seed % 2;
        const int artifacts = 2 + static_cast<int>(random() % 4);
        Exhibit exhibit = sample::exhibit(static_cast<std::size_t>(artifacts), languages, buttons);
        Ledger ledger(buttons);
        MonotonicTime now = start;
        for (int k = 0; k < 60; ++k) {
            now += milliseconds(random() % 400);
            std::vector<Command> commands;
            for (auto each = random() % 3; each > 0; --each) {
                const std::size_t button = random() % (buttons + 1);
                commands.push_back(button < buttons ? button_commands.at(button) : Command::StaffMode);
                button < buttons ? ledger.press(button) : ledger.chord();
            }
            ASSERT_EQ(exhibit.step(now, commands, situation(now)).staff, ledger.staff) << seed;
        }
        const Presentation shown = settled(exhibit, now);
        ASSERT_EQ(shown.artifact, ledger.artifact(artifacts)) << seed;
        ASSERT_EQ(shown.language, languages[ledger.language(3)]) << seed;
    }
}

TEST(Exhibit, TheStaffsPatternEndsByItself) {
    Exhibit exhibit = sample::exhibit(2, languages);
    const std::array chord{Command::StaffMode};
    const auto staff_at = [&](MonotonicTime now) { return exhibit.step(now, {}, situation(now)).staff; };
    EXPECT_TRUE(exhibit.step(start, chord, situation(start)).staff);
    EXPECT_TRUE(staff_at(start + Exhibit::staff_time - milliseconds(1)));
    EXPECT_FALSE(staff_at(start + Exhibit::staff_time));
    EXPECT_TRUE(exhibit.step(start + Exhibit::staff_time, chord, situation(start)).staff);
    exhibit.end_staff_mode();
    EXPECT_FALSE(staff_at(start + Exhibit::staff_time));
}

TEST(Exhibit, TheChordOnTheStaffsPatternAsksForACalibration) {
    const std::array chord{Command::StaffMode};
    const std::array first{Command::PreviousArtifact};
    const std::array last{Command::NextLanguage};
    Exhibit exhibit = sample::exhibit(2, languages);
    MonotonicTime now = start;
    const auto held = [&](Nanoseconds until_chord) {
        static_cast<void>(exhibit.step(now, first, situation(now)));
        static_cast<void>(exhibit.step(now + milliseconds(50), last, situation(now)));
        now += until_chord;
        return exhibit.step(now, chord, situation(now));
    };
    const Presentation once = held(seconds(3));
    EXPECT_TRUE(once.staff);
    EXPECT_FALSE(once.calibrate);
    const std::size_t artifact = exhibit.chosen();
    const std::string language = exhibit.language();
    now += seconds(10);
    const Presentation again = held(seconds(3));
    EXPECT_TRUE(again.staff) << "and where nobody sees to it, the pattern is there";
    EXPECT_TRUE(again.calibrate);
    EXPECT_EQ(exhibit.chosen(), artifact) << "its presses are undone";
    EXPECT_EQ(exhibit.language(), language);
    now += milliseconds(20);
    EXPECT_FALSE(exhibit.step(now, {}, situation(now)).calibrate) << "it is asked once";
    static_cast<void>(exhibit.step(now, first, situation(now))); // a press ends the pattern
    now += Exhibit::chord_again;
    EXPECT_FALSE(held(seconds(3)).calibrate) << "that was another one";
}

TEST(Exhibit, TheLampsAreThoseOfTheButtonsThatDoSomething) {
    const auto lamps = [](std::size_t artifacts, const std::vector<std::string>& tags) {
        return sample::exhibit(artifacts, tags).step(start, {}, situation(start)).lamps;
    };
    EXPECT_EQ(lamps(1, {"en"}), 0b000U);
    EXPECT_EQ(lamps(2, {"en"}), 0b011U);
    EXPECT_EQ(lamps(1, {"en", "de"}), 0b100U);
    EXPECT_EQ(lamps(2, {"en", "de"}), 0b111U);
    EXPECT_EQ(lamps(0, {}), 0b000U);
}

TEST(Exhibit, WithoutItsPropTheArtifactStandsAtAPlaceOfItsOwn) {
    Exhibit exhibit = sample::exhibit(2, languages);
    Situation known = situation(start);
    known.table_from_prop.translation = {0.1, 0.05, 0.0};
    const Presentation with = exhibit.step(start, {}, known);
    EXPECT_FALSE(with.attracts);
    EXPECT_EQ(with.table_from_prop.translation, known.table_from_prop.translation);
    const MonotonicTime later = start + seconds(10);
    const Presentation without = exhibit.step(later, {}, situation(later, start));
    EXPECT_TRUE(without.attracts);
    EXPECT_EQ(without.table_from_prop.translation, glm::dvec3(0.0));
    EXPECT_EQ(without.brightness, 1.0);
}

TEST(Exhibit, NothingAndNoCaptionsAreNoTrouble) {
    Exhibit none = sample::exhibit(0, {});
    EXPECT_EQ(none.step(start + rest, button_commands, situation(start)).brightness, 0.0);
    Exhibit silent = sample::exhibit(2, {});
    const Presentation shown = settled(silent, start);
    EXPECT_FALSE(shown.caption);
    EXPECT_EQ(shown.language, "en");
    EXPECT_TRUE(shown.settled);
}

TEST(Exhibit, AStepAllocatesNothing) {
    Exhibit exhibit = sample::exhibit(3, languages);
    std::mt19937 random(4);
    MonotonicTime now = start;
    static_cast<void>(exhibit.step(now, {}, situation(now)));
    if (!synthetic::allocations_are_counted) {
        GTEST_SKIP() << "a sanitizer allocates by itself";
    }
    const long before = synthetic::allocations_so_far();
    for (int k = 0; k < 2000; ++k) {
        now += milliseconds(16);
        Situation moved = situation(now);
        moved.table_from_prop.translation.x = 0.3 * std::sin(0.01 * k);
        const std::array commands{button_commands.at(random() % 3), Command::StaffMode};
        static_cast<void>(exhibit.step(now, std::span(commands).first(random() % 40 == 0 ? 2 : 0), moved));
    }
    EXPECT_EQ(synthetic::allocations_so_far(), before);
}

TEST(Commands, EachButtonHasOne) {
    for (int button = 0; button < static_cast<int>(button_commands.size()); ++button) {
        EXPECT_EQ(button_of(*command_of_button(button)), button);
    }
    EXPECT_FALSE(command_of_button(-1));
    EXPECT_FALSE(command_of_button(static_cast<int>(button_commands.size())));
}

} // namespace
} // namespace frustumscreen
