#include "firmware_host/panel/button_panel.h"
#include "firmware_host/panel/key_levels.h"
#include "firmware_host/panel/key_lines.h"
#include "tests/base/comes_true.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <bit>
#include <random>

namespace frustumscreen::panel {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

/// An event in the layout of a 64-bit kernel: 16 bytes of time, u16 type, u16 code, s32 value.
std::vector<std::byte> event(unsigned type, unsigned code, int value) {
    std::vector<std::byte> bytes(16, std::byte{0x5a}); // the time is not used
    const auto u = static_cast<unsigned>(value);
    for (const unsigned byte : {type, type >> 8U, code, code >> 8U, u, u >> 8U, u >> 16U, u >> 24U}) {
        bytes.push_back(static_cast<std::byte>(byte));
    }
    return bytes;
}

// linux/input-event-codes.h
constexpr unsigned syn = 0;
constexpr unsigned key = 1;
constexpr unsigned report = 0;
constexpr unsigned dropped = 3;
constexpr std::uint16_t left = 105;
constexpr std::uint16_t right = 106;

class KeyLevelsTest : public ::testing::Test {
protected:
    void SetUp() override {
        if (sizeof(void*) != 8 || std::endian::native != std::endian::little) {
            GTEST_SKIP() << "the bytes are those of a 64-bit little-endian kernel";
        }
    }
    KeyLevels levels{{left, right}};
};

TEST_F(KeyLevelsTest, FollowsOnlyTheRequestedKeys) {
    EXPECT_FALSE(levels.take(event(key, left, 1)));
    EXPECT_TRUE(levels.down(0));
    EXPECT_FALSE(levels.down(1));
    EXPECT_FALSE(levels.take(event(key, left, 2))); // key repeat
    EXPECT_TRUE(levels.down(0));
    EXPECT_FALSE(levels.take(event(key, 30, 1))); // another key
    EXPECT_FALSE(levels.take(event(2, left, 1))); // a movement with the same code
    EXPECT_FALSE(levels.down(1));
    EXPECT_FALSE(levels.take(event(key, left, 0)));
    EXPECT_FALSE(levels.down(0));
}

TEST_F(KeyLevelsTest, AcceptsEventsSplitAnywhere) {
    std::vector<std::byte> bytes;
    for (const auto& each : {event(key, left, 1), event(syn, report, 0), event(key, right, 1),
                             event(syn, report, 0), event(key, left, 0), event(syn, report, 0)}) {
        bytes.insert(bytes.end(), each.begin(), each.end());
    }
    for (std::size_t cut = 0; cut <= bytes.size(); ++cut) {
        KeyLevels cut_levels({left, right});
        EXPECT_FALSE(cut_levels.take(std::span(bytes).first(cut)));
        EXPECT_FALSE(cut_levels.take(std::span(bytes).subspan(cut)));
        EXPECT_FALSE(cut_levels.down(0)) << cut;
        EXPECT_TRUE(cut_levels.down(1)) << cut;
    }
}

TEST_F(KeyLevelsTest, RequestsLevelsAgainAfterDroppedEvents) {
    EXPECT_FALSE(levels.take(event(key, left, 1)));
    EXPECT_TRUE(levels.take(event(syn, dropped, 0)));
    EXPECT_FALSE(levels.take(event(key, right, 1))); // belongs to the incomplete report
    EXPECT_FALSE(levels.down(1));
    EXPECT_FALSE(levels.take(event(syn, report, 0)));
    EXPECT_FALSE(levels.take(event(key, right, 1)));
    EXPECT_TRUE(levels.down(1));
    std::array<std::byte, 96> bits{};
    bits[13] = std::byte{0x04}; // bit 106: right
    levels.set(bits);
    EXPECT_FALSE(levels.down(0));
    EXPECT_TRUE(levels.down(1));
    levels.set(std::span(bits).first(13)); // the answer is too short
    EXPECT_FALSE(levels.down(1));
}

TEST_F(KeyLevelsTest, RecoversFromArbitraryBytes) {
    std::mt19937 random(5);
    std::size_t taken = 0;
    for (int k = 0; k < 20'000; ++k) {
        std::vector<std::byte> bytes(random() % 100);
        for (std::byte& byte : bytes) {
            byte = static_cast<std::byte>(random() % 4); // mostly valid event types
        }
        (void)levels.take(bytes);
        taken += bytes.size();
    }
    // Zeros complete a partial event, and a report ends the dropped state; then events count normally.
    const std::size_t event_bytes = event(syn, report, 0).size();
    (void)levels.take(std::vector<std::byte>(event_bytes - taken % event_bytes));
    (void)levels.take(event(syn, report, 0));
    levels.set(std::array<std::byte, 96>{});
    EXPECT_FALSE(levels.take(event(key, right, 1)));
    EXPECT_FALSE(levels.down(0));
    EXPECT_TRUE(levels.down(1));
}

TEST(KeyCodes, MapsKeyNamesAndRejectsOthers) {
    const std::vector<std::string> names{"KEY_LEFT", "KEY_RIGHT", "KEY_A"};
    const auto codes = key_codes(names);
    ASSERT_TRUE(codes);
    EXPECT_EQ(*codes, (std::vector<std::uint16_t>{105, 106, 30}));
    for (const char* wrong : {"KEY_NO_SUCH", "", "left", "EV_KEY"}) {
        const auto none = key_codes(std::vector<std::string>{wrong});
        ASSERT_FALSE(none) << wrong;
        EXPECT_EQ(none.error().kind, ErrorKind::BadConfiguration);
    }
}

TEST(KeyLines, NamesAMissingKeyboard) {
    for (const char* device : {"/dev/input/event-none", "No such keyboard"}) {
        const auto lines = open_key_lines({device, {left}});
        ASSERT_FALSE(lines);
        EXPECT_EQ(lines.error().kind, ErrorKind::DeviceLost);
        EXPECT_NE(lines.error().message.find(device), std::string::npos);
        EXPECT_EQ(lines.error().id, "panel.keyboard_lost") << lines.error().message;
    }
    const auto no_keyboard = open_key_lines({"/dev/null", {left}});
    ASSERT_FALSE(no_keyboard);
    EXPECT_EQ(no_keyboard.error().id, "panel.no_event_device") << no_keyboard.error().message;
}

/// Counts the readings of another device's lines.
class CountedLines final : public ButtonLines {
public:
    CountedLines(std::unique_ptr<ButtonLines> lines, std::atomic<int>& readings)
        : lines_(std::move(lines)), readings_(readings) {}
    [[nodiscard]] Result<void> read(std::span<bool> down) override {
        Result<void> read = lines_->read(down);
        ++readings_;
        return read;
    }
    [[nodiscard]] Result<void> wait(Nanoseconds timeout) override { return lines_->wait(timeout); }

private:
    std::unique_ptr<ButtonLines> lines_;
    std::atomic<int>& readings_;
};

/// A keyboard backed by a pipe: the test writes the bytes that the kernel would send.
struct PipeKeyboard {
    std::array<int, 2> ends{-1, -1};
    std::atomic<bool> plugged{false}; ///< opening waits for it, so that what a loss says stays to be seen
    std::atomic<int> readings{0};     ///< since it was plugged in

    [[nodiscard]] Result<std::unique_ptr<ButtonLines>> open() {
        plugged.wait(false);
        if (::pipe(ends.data()) != 0) {
            return fail(ErrorKind::DeviceLost, "test.device", "no pipe");
        }
        return std::make_unique<CountedLines>(key_lines_over(ends[0], "pipe", {left, right}), readings);
    }
    void send(unsigned code, int value) const {
        std::vector<std::byte> bytes = event(key, code, value);
        const std::vector<std::byte> end = event(syn, report, 0);
        bytes.insert(bytes.end(), end.begin(), end.end());
        ASSERT_EQ(::write(ends[1], bytes.data(), bytes.size()), static_cast<ssize_t>(bytes.size()));
    }
    void unplug() {
        plugged = false;
        ::close(std::exchange(ends[1], -1));
    }
    void plug() {
        readings = 0;
        plugged = true;
        plugged.notify_all();
    }
};

/// Lets the panel's thread end.
struct PluggedAtTheEnd {
    PipeKeyboard& keyboard;
    ~PluggedAtTheEnd() { keyboard.plug(); }
};

TEST_F(KeyLevelsTest, PanelReportsPressesAgainAfterReplugging) {
    PipeKeyboard keyboard;
    ButtonTimes times;
    times.debounce = milliseconds(5);
    ButtonPanel panel([&] { return keyboard.open(); }, 2, times);
    const PluggedAtTheEnd at_the_end{keyboard};
    std::vector<PanelEvent> events;
    const auto until = [&](const auto& done) {
        return comes_true([&] {
            EXPECT_TRUE(panel.poll(monotonic_now(), events));
            return done();
        });
    };
    for (int plugged = 1; plugged <= 2; ++plugged) {
        keyboard.plug();
        ASSERT_TRUE(until([&] { return keyboard.readings > 0; })); // levels are known before they change
        events.clear();
        keyboard.send(right, 1);
        ASSERT_TRUE(until([&] { return !events.empty(); }));
        EXPECT_EQ(events[0].button, 1);
        EXPECT_EQ(events[0].kind, PressKind::Press);
        keyboard.send(right, 0);
        keyboard.unplug();
        ASSERT_TRUE(until([&] { return panel.state().find("keyboard pipe: it is not there") == 0; }));
    }
}

} // namespace
} // namespace frustumscreen::panel
