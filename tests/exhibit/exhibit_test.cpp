// The exhibit's decisions, compared with a table and with a counting model.

#include "tests/exhibit/exhibits.h"
#include "tests/render/counted_new.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <random>

namespace frustumscreen::exhibit {
namespace {

using sample::start;
using sample::tracked_state;
using std::chrono::milliseconds;
using std::chrono::seconds;

constexpr Nanoseconds rest = seconds(3); ///< all fades are over

/// The effect of one command, by the state in which it arrives.
struct Row {
    bool staff;
    settings::Command command;
    bool staff_after;
    int artifact_step;
    int language_step;
};
constexpr std::array table{
    Row{false, settings::Command::PreviousArtifact, false, -1, 0},
    Row{false, settings::Command::NextArtifact, false, 1, 0},
    Row{false, settings::Command::NextLanguage, false, 0, 1},
    Row{false, settings::Command::StaffMode, true, 0, 0},
    Row{false, settings::Command::HoldFirst, false, 0, 0},
    Row{false, settings::Command::HoldOther, false, 0, 0},
    Row{true, settings::Command::PreviousArtifact, true, 0, 0},
    Row{true, settings::Command::NextArtifact, true, 0, 0},
    Row{true, settings::Command::NextLanguage, true, 0, 0},
    Row{true, settings::Command::StaffMode, false, 0, 0},
    Row{true, settings::Command::HoldFirst, true, 0, 0},
    Row{true, settings::Command::HoldOther, true, 0, 0},
};

const std::vector<std::string> languages{"en", "de", "fr"};

/// The presentation after all fades: a caption appears in the frame that places it.
Presentation settled(Exhibit& exhibit, MonotonicTime now) {
    const MonotonicTime end = now + rest;
    for (; now < end; now += milliseconds(50)) {
        static_cast<void>(exhibit.step(now, {}, tracked_state(now)));
    }
    return exhibit.step(end, {}, tracked_state(end));
}

TEST(Exhibit, EachCommandHasTheTabulatedEffect) {
    for (const Row& row : table) {
        Exhibit exhibit = sample::exhibit(4, languages);
        MonotonicTime now = start;
        if (row.staff) {
            const std::array chord{settings::Command::StaffMode};
            EXPECT_TRUE(exhibit.step(now, chord, tracked_state(now)).staff);
        }
        now += seconds(1);
        EXPECT_EQ(exhibit.step(now, std::span(&row.command, 1), tracked_state(now)).staff, row.staff_after);
        if (row.staff_after) {
            static_cast<void>(
                exhibit.step(now, std::array{settings::Command::StaffMode}, tracked_state(now)));
        }
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

/// Counts every press, by button. A chord removes the latest press of the first and of the last button, if that press
/// reached the exhibit.
class Ledger {
public:
    explicit Ledger(std::size_t buttons) : buttons_(buttons) {}

    void press(std::size_t button) {
        latest_counts_[button] = !staff;
        counted_[button] += staff ? 0 : 1;
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

TEST(Exhibit, RandomPressesMatchACountingModel) {
    for (unsigned seed = 0; seed < 300; ++seed) {
        std::mt19937 random(seed);
        const std::size_t buttons = 2 + seed % 2;
        const int artifacts = 2 + static_cast<int>(random() % 4);
        Exhibit exhibit = sample::exhibit(static_cast<std::size_t>(artifacts), languages, buttons);
        Ledger ledger(buttons);
        MonotonicTime now = start;
        for (int k = 0; k < 60; ++k) {
            now += milliseconds(random() % 400);
            std::vector<settings::Command> commands;
            for (auto each = random() % 3; each > 0; --each) {
                const std::size_t button = random() % (buttons + 1);
                commands.push_back(button < buttons ? settings::button_commands.at(button)
                                                    : settings::Command::StaffMode);
                button < buttons ? ledger.press(button) : ledger.chord();
            }
            ASSERT_EQ(exhibit.step(now, commands, tracked_state(now)).staff, ledger.staff) << seed;
        }
        const Presentation shown = settled(exhibit, now);
        ASSERT_EQ(shown.artifact, ledger.artifact(artifacts)) << seed;
        ASSERT_EQ(shown.language, languages[ledger.language(3)]) << seed;
    }
}

TEST(Exhibit, StaffPictureTimesOut) {
    Exhibit exhibit = sample::exhibit(2, languages);
    const std::array chord{settings::Command::StaffMode};
    const auto staff_at = [&](MonotonicTime now) { return exhibit.step(now, {}, tracked_state(now)).staff; };
    EXPECT_TRUE(exhibit.step(start, chord, tracked_state(start)).staff);
    EXPECT_TRUE(staff_at(start + StaffTool::after_press - milliseconds(1)));
    EXPECT_FALSE(staff_at(start + StaffTool::after_press));
    EXPECT_TRUE(exhibit.step(start + StaffTool::after_press, chord, tracked_state(start)).staff);
    exhibit.end_staff_mode();
    EXPECT_FALSE(staff_at(start + StaffTool::after_press));
}

/// From the chord to the table's calibration, and the effect of its presses.
TEST(Exhibit, StaffRequestCalibrationOnThePlacePage) {
    Exhibit exhibit = sample::exhibit(2, languages);
    MonotonicTime now = start;
    const auto step = [&](std::initializer_list<settings::Command> commands) {
        now += milliseconds(400);
        return exhibit.step(now, std::span(commands.begin(), commands.size()), tracked_state(now));
    };
    const std::size_t artifact = exhibit.chosen();
    static_cast<void>(step({settings::Command::PreviousArtifact, settings::Command::NextLanguage}));
    EXPECT_TRUE(step({settings::Command::StaffMode}).staff);
    EXPECT_FALSE(step({settings::Command::PreviousArtifact, settings::Command::HoldFirst}).calibrate)
        << "the first page has nothing to measure";
    EXPECT_EQ(step({settings::Command::NextArtifact}).staff_view.page, StaffPage::Place);
    EXPECT_FALSE(step({settings::Command::NextLanguage, settings::Command::HoldOther}).calibrate);
    const Presentation asked = step({settings::Command::PreviousArtifact, settings::Command::HoldFirst});
    EXPECT_TRUE(asked.calibrate);
    EXPECT_TRUE(asked.staff) << "and if it is not handled, the picture is there";
    EXPECT_FALSE(step({}).calibrate) << "it is asked once";
    EXPECT_FALSE(step({settings::Command::StaffMode}).staff);
    EXPECT_FALSE(step({settings::Command::HoldFirst}).calibrate);
    EXPECT_EQ(exhibit.chosen(), artifact)
        << "the chord's presses are undone, and those on the staff's picture are no visitor's";
    EXPECT_EQ(exhibit.language(), "en");
}

TEST(Exhibit, StaffPictureStaysWithoutACalibration) {
    ExhibitPlace place = sample::place();
    place.buttons = 3;
    place.staff_stays = true;
    Exhibit exhibit({}, place, "en", start);
    const std::array chord{settings::Command::StaffMode};
    EXPECT_TRUE(exhibit.step(start, chord, tracked_state(start)).staff_view.stays);
    const MonotonicTime later = start + std::chrono::hours(20);
    EXPECT_TRUE(exhibit.step(later, {}, tracked_state(later)).staff);
    EXPECT_FALSE(exhibit.step(later, chord, tracked_state(later)).staff);
}

TEST(Exhibit, LongPressIsNotASecondPress) {
    Exhibit exhibit = sample::exhibit(4, languages);
    static_cast<void>(exhibit.step(start, std::array{settings::Command::NextArtifact}, tracked_state(start)));
    const MonotonicTime pressed = *exhibit.used();
    const MonotonicTime later = start + seconds(2);
    static_cast<void>(exhibit.step(later, std::array{settings::Command::HoldOther}, tracked_state(later)));
    EXPECT_EQ(exhibit.chosen(), 1U);
    EXPECT_EQ(exhibit.used(), pressed);
}

TEST(Exhibit, LightsOnlyLampsOfButtonsWithAnEffect) {
    const auto lamps = [](std::size_t artifacts, const std::vector<std::string>& tags) {
        return sample::exhibit(artifacts, tags).step(start, {}, tracked_state(start)).lamps;
    };
    EXPECT_EQ(lamps(1, {"en"}), 0b000U);
    EXPECT_EQ(lamps(2, {"en"}), 0b011U);
    EXPECT_EQ(lamps(1, {"en", "de"}), 0b100U);
    EXPECT_EQ(lamps(2, {"en", "de"}), 0b111U);
    EXPECT_EQ(lamps(0, {}), 0b000U);
}

TEST(Exhibit, ShowsTheArtifactAtItsIdlePlaceWithoutTheProp) {
    Exhibit exhibit = sample::exhibit(2, languages);
    tracking::TrackedState known = tracked_state(start);
    known.table_from_prop.translation = {0.1, 0.05, 0.0};
    const Presentation with = exhibit.step(start, {}, known);
    EXPECT_FALSE(with.attracts);
    EXPECT_EQ(with.table_from_prop.translation, known.table_from_prop.translation);
    const MonotonicTime later = start + seconds(10);
    const Presentation without = exhibit.step(later, {}, tracked_state(later, start));
    EXPECT_TRUE(without.attracts);
    EXPECT_EQ(without.table_from_prop.translation, glm::dvec3(0.0));
    EXPECT_EQ(without.brightness, 1.0);
}

TEST(Exhibit, WorksWithoutArtifactsOrCaptions) {
    Exhibit none = sample::exhibit(0, {});
    EXPECT_EQ(none.step(start + rest, settings::button_commands, tracked_state(start)).brightness, 0.0);
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
    static_cast<void>(exhibit.step(now, {}, tracked_state(now)));
    if (!synthetic::allocations_are_counted) {
        GTEST_SKIP() << "a sanitizer allocates by itself";
    }
    const long before = synthetic::allocations_so_far();
    for (int k = 0; k < 2000; ++k) {
        now += milliseconds(16);
        tracking::TrackedState moved = tracked_state(now);
        moved.table_from_prop.translation.x = 0.3 * std::sin(0.01 * k);
        const std::array commands{settings::button_commands.at(random() % 3), settings::Command::HoldOther,
                                  settings::Command::StaffMode};
        static_cast<void>(
            exhibit.step(now, std::span(commands).last(random() % 40 == 0 ? random() % 4 : 0), moved));
    }
    EXPECT_EQ(synthetic::allocations_so_far(), before);
}

TEST(Commands, EachButtonHasACommand) {
    for (int button = 0; button < static_cast<int>(settings::button_commands.size()); ++button) {
        EXPECT_EQ(settings::button_of(*settings::command_of_button(button)), button);
    }
    EXPECT_FALSE(settings::command_of_button(-1));
    EXPECT_FALSE(settings::command_of_button(static_cast<int>(settings::button_commands.size())));
}

} // namespace
} // namespace frustumscreen::exhibit
