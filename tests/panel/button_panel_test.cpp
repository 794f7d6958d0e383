#include "firmware_host/panel/button_panel.h"
#include "tests/base/comes_true.h"

#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <thread>

namespace frustumscreen::panel {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

constexpr milliseconds debounce(1);
constexpr milliseconds longer_than_debounce(2); ///< between two rounds

/// A chip that a test plugs in, unplugs and presses.
struct FakeChip {
    std::array<std::atomic<bool>, 3> down{};
    std::array<std::atomic<bool>, 3> lit{};
    std::atomic<bool> plugged{true};
    std::atomic<int> opened{0};
    std::atomic<int> rounds{0}; ///< number of reads of the levels
    std::string remark;
};

class FakeLines final : public ButtonLines {
public:
    explicit FakeLines(FakeChip& chip) : chip_(chip) {}
    [[nodiscard]] Result<void> read(std::span<bool> down) override {
        if (!chip_.plugged) {
            return fail(ErrorKind::DeviceLost, "test.device", "unplugged");
        }
        for (std::size_t k = 0; k < down.size(); ++k) {
            down[k] = chip_.down.at(k);
        }
        ++chip_.rounds;
        return {};
    }
    [[nodiscard]] Result<void> wait(Nanoseconds) override {
        std::this_thread::sleep_for(longer_than_debounce);
        return {};
    }

    [[nodiscard]] Result<void> light(std::span<const bool> lit) override {
        std::copy(lit.begin(), lit.end(), chip_.lit.begin());
        return {};
    }

    [[nodiscard]] std::string_view remark() const override { return chip_.remark; }

private:
    FakeChip& chip_;
};

OpenLines opener(FakeChip& chip) {
    return [&chip]() -> Result<std::unique_ptr<ButtonLines>> {
        if (!chip.plugged) {
            return fail(ErrorKind::DeviceLost, "test.device", "not there");
        }
        ++chip.opened;
        return std::make_unique<FakeLines>(chip);
    };
}

/// Waits until the present levels count: one round may be in progress, one reads them, one finds that they
/// have held for the debounce time, and one more begins after that was reported. The panel is not polled
/// meanwhile.
void let_levels_count(const FakeChip& chip) {
    const int begin = chip.rounds;
    while (chip.rounds < begin + 4) {
        std::this_thread::sleep_for(milliseconds(1));
    }
}

/// Polls until `done`.
template <typename Done> bool until(ButtonPanel& panel, std::vector<PanelEvent>& events, const Done& done) {
    return comes_true([&] {
        EXPECT_TRUE(panel.poll(monotonic_now(), events));
        return done();
    });
}

TEST(ButtonPanel, ReportsPressesAndReopensAnUnpluggedChip) {
    FakeChip chip;
    ButtonTimes times;
    times.debounce = debounce;
    ButtonPanel panel(opener(chip), 3, times);
    std::vector<PanelEvent> events;
    EXPECT_EQ(panel.condition().health, DeviceHealth::Away) << "it was not looked for yet";
    ASSERT_TRUE(until(panel, events, [&] { return panel.state() == "its buttons are there"; }));
    EXPECT_EQ(panel.condition().health, DeviceHealth::Well);
    let_levels_count(chip); // they are known before they change
    chip.down[1] = true;
    ASSERT_TRUE(until(panel, events, [&] { return !events.empty(); }));
    EXPECT_EQ(events[0].button, 1);
    chip.down[1] = false;
    chip.plugged = false;
    ASSERT_TRUE(until(panel, events, [&] { return panel.state() == "not there"; }));
    EXPECT_EQ(panel.condition().health, DeviceHealth::Away);
    chip.plugged = true;
    ASSERT_TRUE(until(panel, events, [&] { return panel.state() == "its buttons are there"; }));
    EXPECT_EQ(chip.opened, 2);
    let_levels_count(chip);
    events.clear();
    chip.down[2] = true;
    ASSERT_TRUE(until(panel, events, [&] { return !events.empty(); }));
    EXPECT_EQ(events[0].button, 2);
}

TEST(ButtonPanel, ChordEndsOnReleaseTimeoutOrUnplug) {
    FakeChip chip;
    ButtonTimes times;
    times.debounce = debounce;
    ButtonPanel panel(opener(chip), 3, times);
    std::vector<PanelEvent> events;
    const auto held = [&panel] { return panel.chord_held(monotonic_now()); };
    const auto press_both = [&](bool down) {
        chip.down[0] = down;
        chip.down[2] = down;
    };
    ASSERT_TRUE(until(panel, events, [&] { return panel.state() == "its buttons are there"; }));
    let_levels_count(chip); // levels must be known before they change
    EXPECT_FALSE(held());
    press_both(true);
    ASSERT_TRUE(until(panel, events, held));
    EXPECT_FALSE(panel.chord_held(monotonic_now() + ButtonPanel::held_for + seconds(1)))
        << "its thread was not heard of since";
    chip.down[0] = false;
    ASSERT_TRUE(until(panel, events, [&] { return !held(); }));
    chip.down[0] = true;
    ASSERT_TRUE(until(panel, events, held));
    chip.plugged = false;
    ASSERT_TRUE(until(panel, events, [&] { return panel.state() == "not there"; }));
    EXPECT_FALSE(held());
}

TEST(ButtonPanel, KeepsTheNewestEventsWithoutPolling) {
    FakeChip chip;
    ButtonTimes times;
    times.debounce = debounce;
    times.chatter_window = Nanoseconds(0); // disables the limit on frequent presses
    ButtonPanel panel(opener(chip), 3, times);
    std::vector<PanelEvent> events;
    ASSERT_TRUE(until(panel, events, [&] { return panel.state() == "its buttons are there"; }));
    for (std::size_t k = 0; k < ButtonPanel::max_waiting + 10; ++k) {
        chip.down[0] = true;
        let_levels_count(chip);
        chip.down[0] = false;
        let_levels_count(chip);
    }
    chip.down[2] = true;
    let_levels_count(chip);
    events.clear();
    ASSERT_TRUE(panel.poll(monotonic_now(), events));
    ASSERT_LE(events.size(), ButtonPanel::max_waiting);
    ASSERT_FALSE(events.empty());
    EXPECT_EQ(events.back().button, 2);
}

TEST(ButtonPanel, LightsRequestedLampsExceptThoseOfStuckButtons) {
    FakeChip chip;
    const auto lit = [&chip](bool a, bool b, bool c) {
        return chip.lit[0] == a && chip.lit[1] == b && chip.lit[2] == c;
    };
    {
        ButtonTimes times;
        times.debounce = debounce;
        times.stuck = milliseconds(50);
        ButtonPanel panel(opener(chip), 3, times);
        std::vector<PanelEvent> events;
        ASSERT_TRUE(until(panel, events, [&] { return chip.opened == 1; }));
        EXPECT_TRUE(lit(false, false, false));
        panel.light(0b011U);
        ASSERT_TRUE(until(panel, events, [&] { return lit(true, true, false); }));
        chip.down[1] = true;
        ASSERT_TRUE(until(panel, events, [&] { return lit(true, false, false); }));
        chip.down[1] = false;
        ASSERT_TRUE(until(panel, events, [&] { return lit(true, true, false); }));
        chip.plugged = false;
        ASSERT_TRUE(until(panel, events, [&] { return panel.state() == "not there"; }));
        for (auto& lamp : chip.lit) {
            lamp = false; // it lost power
        }
        chip.plugged = true;
        ASSERT_TRUE(until(panel, events, [&] { return lit(true, true, false); }));
    }
    EXPECT_TRUE(lit(false, false, false));
}

TEST(ButtonPanel, ReportsAChatteringButtonAndDarkensItsLamp) {
    FakeChip chip;
    ButtonTimes times;
    times.debounce = debounce;
    times.quiet = milliseconds(300);
    ButtonPanel panel(opener(chip), 3, times);
    panel.light(0b111U);
    std::vector<PanelEvent> events;
    ASSERT_TRUE(until(panel, events, [&] { return chip.lit[1].load(); }));
    const auto chatters = [&] { return panel.state().find("a button chatters and is ignored") == 0; };
    ASSERT_TRUE(until(panel, events, [&] { // after a pause it is quiet, and is lit until it chatters again
        chip.down[1] = !chip.down[1];
        let_levels_count(chip);
        return chatters() && !chip.lit[1];
    }));
    EXPECT_TRUE(chip.lit[0] && chip.lit[2]);
    chip.down[1] = false;
    ASSERT_TRUE(until(panel, events, [&] { return panel.state() == "its buttons are there"; }));
    ASSERT_TRUE(until(panel, events, [&] { return chip.lit[1].load(); }));
}

TEST(ButtonPanel, ReportsTheRemarkUnlessAButtonIsStuck) {
    FakeChip chip;
    chip.remark = "a lamp cannot be lit";
    ButtonTimes times;
    times.debounce = debounce;
    times.stuck = milliseconds(50);
    ButtonPanel panel(opener(chip), 3, times);
    std::vector<PanelEvent> events;
    ASSERT_TRUE(until(panel, events, [&] { return panel.state() == "a lamp cannot be lit"; }));
    chip.down[0] = true;
    ASSERT_TRUE(until(panel, events, [&] { return panel.state().find("a button is stuck") == 0; }));
    EXPECT_EQ(panel.condition().health, DeviceHealth::Impaired);
    EXPECT_EQ(panel.condition().id, "panel.stuck");
    chip.down[0] = false;
    ASSERT_TRUE(until(panel, events, [&] { return panel.state() == "a lamp cannot be lit"; }));
}

TEST(ButtonPanel, NamesAMissingChip) {
    const Result<std::unique_ptr<ButtonLines>> lines = open_gpio_lines({"no-such-chip", {"0"}});
    ASSERT_FALSE(lines);
    EXPECT_EQ(lines.error().kind, ErrorKind::DeviceLost);
    EXPECT_NE(lines.error().message.find("no-such-chip"), std::string::npos);
    EXPECT_NE(lines.error().message.find("plugged in"), std::string::npos) << lines.error().message;
}

} // namespace
} // namespace frustumscreen::panel
