// The buttons' lines through libgpiod, over a chip with the kernel's GPIO interface. Started by
// umockdev-wrapper.

#include "firmware_host/panel/button_lines.h"
#include "firmware_host/panel/button_panel.h"
#include "tests/base/comes_true.h"
#include "tests/panel/fake_gpio_chip.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <thread>

namespace frustumscreen::panel {
namespace {

LineRequest three_buttons() {
    LineRequest request;
    request.chip = "gpiochip2";
    request.lines = {"2", "L4", "6"};
    return request;
}

std::vector<std::uint32_t> offsets_of(const gpiohandle_request& request) {
    return {request.lineoffsets, request.lineoffsets + request.lines};
}

class GpioLines : public ::testing::Test {
protected:
    void TearDown() override { EXPECT_EQ(chip.left_open(), 0U); }
    /// Opening fails with a sentence that contains `words`, and leaves no file open.
    void refuses(const LineRequest& request, const std::string& words) {
        chip.expect_opening();
        const auto lines = open_gpio_lines(request);
        ASSERT_FALSE(lines) << words;
        EXPECT_EQ(lines.error().kind, ErrorKind::DeviceLost);
        EXPECT_NE(lines.error().message.find("gpiochip2"), std::string::npos) << lines.error().message;
        EXPECT_NE(lines.error().message.find(words), std::string::npos) << lines.error().message;
    }

    GpioChip chip;
};

TEST_F(GpioLines, FindsLinesByNameOrOffsetAndReadsThemInOrder) {
    chip.expect_opening();
    auto lines = open_gpio_lines(three_buttons());
    ASSERT_TRUE(lines) << lines.error().message;
    EXPECT_EQ(offsets_of(chip.requested(false)), (std::vector<std::uint32_t>{2, 4, 6}));
    EXPECT_STREQ(chip.requested(false).consumer_label, "frustumscreen");
    EXPECT_EQ(chip.left_open(), 2U) << "the chip and the request";
    EXPECT_EQ((*lines)->remark(), "");
    std::array<bool, 3> down{};
    for (int pressed = -1; pressed < 3; ++pressed) {
        chip.set_levels({0, 1, pressed == 0, 1, pressed == 1, 1, pressed == 2, 1});
        ASSERT_TRUE((*lines)->read(down));
        EXPECT_EQ(down, (std::array{pressed == 0, pressed == 1, pressed == 2}));
        EXPECT_TRUE((*lines)->wait(Nanoseconds(1)));
    }
    EXPECT_TRUE((*lines)->light(down)) << "there are no lamps";
    EXPECT_TRUE(chip.lamps().empty());
}

TEST_F(GpioLines, FindsAChipByPathOrNumber) {
    for (const char* name : {"/dev/gpiochip2", "2"}) {
        chip.expect_opening();
        LineRequest request = three_buttons();
        request.chip = name;
        EXPECT_TRUE(open_gpio_lines(request)) << name;
    }
}

TEST_F(GpioLines, RequestsTheBiasAndPolarityOfTheSettings) {
    const auto flags_for = [this](LineBias bias, bool active_low) {
        chip.expect_opening();
        LineRequest request = three_buttons();
        request.bias = bias;
        request.active_low = active_low;
        EXPECT_TRUE(open_gpio_lines(request));
        return chip.requested(false).flags;
    };
    constexpr std::uint32_t input = GPIOHANDLE_REQUEST_INPUT;
    constexpr std::uint32_t low = GPIOHANDLE_REQUEST_ACTIVE_LOW;
    EXPECT_EQ(flags_for(LineBias::AsIs, false), input);
    EXPECT_EQ(flags_for(LineBias::AsIs, true), input | low);
    EXPECT_EQ(flags_for(LineBias::PullUp, true), input | low | GPIOHANDLE_REQUEST_BIAS_PULL_UP);
    EXPECT_EQ(flags_for(LineBias::PullDown, false), input | GPIOHANDLE_REQUEST_BIAS_PULL_DOWN);
    EXPECT_EQ(flags_for(LineBias::Disabled, true), input | low | GPIOHANDLE_REQUEST_BIAS_DISABLE);
}

TEST_F(GpioLines, LampsStartDarkAndFollowRequests) {
    chip.expect_opening();
    LineRequest request = three_buttons();
    request.lamps = {"3", "L5"};
    auto lines = open_gpio_lines(request);
    ASSERT_TRUE(lines) << lines.error().message;
    EXPECT_EQ(offsets_of(chip.requested(true)), (std::vector<std::uint32_t>{3, 5}));
    EXPECT_EQ(chip.requested(true).flags, std::uint32_t{GPIOHANDLE_REQUEST_OUTPUT});
    EXPECT_EQ(chip.lamps(), (std::vector<int>{0, 0}));
    const std::array lit{true, false, true}; // the third button has no lamp
    ASSERT_TRUE((*lines)->light(lit));
    EXPECT_EQ(chip.lamps(), (std::vector<int>{1, 0}));
    chip.set_trouble(EIO, GPIOHANDLE_SET_LINE_VALUES_IOCTL);
    const Result<void> failed = (*lines)->light(lit);
    ASSERT_FALSE(failed);
    EXPECT_EQ(failed.error().kind, ErrorKind::DeviceLost);
    EXPECT_EQ(failed.error().id, "panel.lamps_lost") << failed.error().message;
}

TEST_F(GpioLines, NamesMissingLines) {
    for (const char* name : {"8", "99", "L8", "2x", "-1", "99999999999999999999"}) {
        LineRequest request = three_buttons();
        request.lines[1] = name;
        refuses(request, std::string("no line ") + name + "; it has 8 lines");
        request = three_buttons();
        request.lamps = {name};
        refuses(request, std::string("no line ") + name);
    }
}

TEST_F(GpioLines, ReportsWhyTheKernelRefusesARequest) {
    LineRequest with_lamps = three_buttons();
    with_lamps.lamps = {"3"};
    const std::array<std::pair<int, const char*>, 4> reasons{{{EBUSY, "another program holds it"},
                                                              {EPERM, "no permission"},
                                                              {ENODEV, "is it plugged in"},
                                                              {EIO, "Input/output error"}}};
    for (const auto& [error, words] : reasons) {
        chip.set_trouble(error, GPIO_GET_LINEHANDLE_IOCTL);
        refuses(three_buttons(), words);
        refuses(with_lamps, words);
    }
    chip.set_trouble(EIO, GPIO_GET_CHIPINFO_IOCTL);
    refuses(three_buttons(), "Input/output error");
}

TEST_F(GpioLines, ReleasesTheButtonsIfLampsAreRefused) {
    LineRequest request = three_buttons();
    request.lamps = {"3"};
    chip.expect_opening(1);
    const auto lines = open_gpio_lines(request);
    ASSERT_FALSE(lines);
    EXPECT_EQ(lines.error().id, "panel.lamps_unlit") << lines.error().message;
    EXPECT_EQ(offsets_of(chip.requested(false)), (std::vector<std::uint32_t>{2, 4, 6}));
}

TEST_F(GpioLines, NamesAMissingChip) {
    LineRequest request = three_buttons();
    for (const char* name : {"gpiochip7", "/dev/gpiochip7", "/dev/hidraw0", "7", "no such label"}) {
        request.chip = name;
        const auto lines = open_gpio_lines(request);
        ASSERT_FALSE(lines) << name;
        EXPECT_EQ(lines.error().kind, ErrorKind::DeviceLost);
        EXPECT_EQ(lines.error().message.find(std::string("the buttons' GPIO chip ") + name + ": "), 0U)
            << lines.error().message;
    }
}

TEST_F(GpioLines, ReadingALostChipFails) {
    chip.expect_opening();
    auto lines = open_gpio_lines(three_buttons());
    ASSERT_TRUE(lines) << lines.error().message;
    std::array<bool, 3> down{true, true, true};
    chip.set_trouble(ENODEV);
    const Result<void> read = (*lines)->read(down);
    ASSERT_FALSE(read);
    EXPECT_EQ(read.error().kind, ErrorKind::DeviceLost);
    EXPECT_NE(read.error().message.find("gpiochip2: it is not there"), std::string::npos)
        << read.error().message;
}

TEST_F(GpioLines, RemarksOnLinesWithAnotherFunction) {
    chip.configuration[3] = std::byte{2}; // TX toggle on line 0
    LineRequest request = three_buttons();
    request.lines[0] = "0";
    chip.expect_opening();
    const auto lines = open_gpio_lines(request);
    ASSERT_TRUE(lines) << lines.error().message;
    EXPECT_NE((*lines)->remark().find("line 0 (panel.lines)"), std::string_view::npos) << (*lines)->remark();
}

TEST_F(GpioLines, PanelReportsPressesAndReopensAnUnpluggedChip) {
    chip.expect_opening();
    chip.expect_opening();
    ButtonTimes times;
    times.debounce = std::chrono::milliseconds(5);
    ButtonPanel panel([] { return open_gpio_lines(three_buttons()); }, 3, times);
    std::vector<PanelEvent> events;
    const auto until = [&](const auto& done) {
        return comes_true([&] {
            EXPECT_TRUE(panel.poll(monotonic_now(), events));
            return done();
        });
    };
    const auto press = [&](int button) {
        events.clear();
        return until([&] { // levels must be known before they change
            chip.set_levels({0, 0, button == 0, 0, button == 1, 0, button == 2, 0});
            std::this_thread::sleep_for(std::chrono::milliseconds(60));
            chip.set_levels({0, 0, 0, 0, 0, 0, 0, 0});
            std::this_thread::sleep_for(std::chrono::milliseconds(60));
            return std::any_of(events.begin(), events.end(),
                               [&](const PanelEvent& event) { return event.button == button; });
        });
    };
    EXPECT_TRUE(press(1)) << panel.state();
    chip.set_trouble(ENODEV);
    ASSERT_TRUE(until([&] { return panel.state().find("is it plugged in") != std::string_view::npos; }));
    chip.set_trouble(0);
    EXPECT_TRUE(press(2)) << panel.state();
}

} // namespace
} // namespace frustumscreen::panel
