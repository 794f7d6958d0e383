// The panel's access to the kernel's files, which umockdev emulates: a CP2112's hidraw device, a keyboard's
// event device, and their ioctls. Started by umockdev-wrapper.

#include "firmware_host/panel/cp2112.h"
#include "firmware_host/panel/key_lines.h"
#include "tests/panel/plugged_devices.h"

#include <gtest/gtest.h>
#include <linux/hidraw.h>
#include <linux/input.h>

#include <atomic>
#include <cerrno>
#include <cstring>
#include <string>
#include <vector>

namespace frustumscreen::panel {
namespace {

std::vector<std::byte> bytes_of(std::initializer_list<unsigned> values) {
    std::vector<std::byte> bytes;
    for (const unsigned value : values) {
        bytes.push_back(static_cast<std::byte>(value));
    }
    return bytes;
}

constexpr const char* hid_device = "/devices/pci0000:00/usb1/1-1/1-1:1.0/0003:10C4:EA90.0001";

std::string listed_chip(const std::string& device) {
    return "P: " + device + "/hidraw/hidraw0\nN: hidraw0\nE: DEVNAME=/dev/hidraw0\nE: SUBSYSTEM=hidraw\n\n" +
           "P: " + device + "/gpiochip2\nE: SUBSYSTEM=gpio\n\n" + "P: " + device + "\nE: SUBSYSTEM=hid\n\n";
}

TEST(Cp2112Files, ReadsTheConfigurationFromTheHidrawDevice) {
    Answer answer{5, bytes_of({2, 0, 0xff, 3, 0})};
    const PluggedDevices chip(listed_chip(hid_device), "/dev/hidraw0", [&](const Asked& asked) {
        return asked.request() == HIDIOCGFEATURE(5) ? answer : Answer{-ENOTTY, {}};
    });
    EXPECT_EQ(read_cp2112_configuration("gpiochip2"), answer.bytes);
    EXPECT_TRUE(read_cp2112_configuration("gpiochip1").empty());
    answer.result = 4; // too short
    EXPECT_TRUE(read_cp2112_configuration("gpiochip2").empty());
    answer = {-EIO, {}}; // just unplugged
    EXPECT_TRUE(read_cp2112_configuration("gpiochip2").empty());
}

TEST(Cp2112Files, DoesNotQueryAnotherChip) {
    const std::string device = "/devices/platform/0003:10C4:EA91.0001";
    const PluggedDevices chip(listed_chip(device), "/dev/hidraw0", [&](const Asked&) {
        ADD_FAILURE() << "nobody is to ask it";
        return Answer{5, bytes_of({2, 0, 0, 7, 0})};
    });
    EXPECT_TRUE(read_cp2112_configuration("gpiochip2").empty());
}

/// Equivalent to a file that this user may not open.
TEST(Cp2112Files, HasNoConfigurationIfTheHidrawDeviceCannotBeOpened) {
    std::string listed = listed_chip(hid_device);
    listed.erase(listed.find("N: hidraw0"), std::strlen("N: hidraw0\n")); // the file is missing
    const PluggedDevices chip(listed);
    EXPECT_TRUE(read_cp2112_configuration("gpiochip2").empty());
}

/// A keyboard with the keys 105 and 106 that counts exclusive grabs.
class Keyboard {
public:
    std::atomic<int> grabbed{0};
    std::atomic<bool> held_by_another{false};

private:
    Answer answer(const Asked& asked) {
        const unsigned long request = asked.request();
        if (request == EVIOCGNAME(255)) {
            return {6, bytes_of({'B', 'e', 'n', 'c', 'h', 0})};
        }
        constexpr std::size_t key_bytes = KEY_MAX / 8 + 1;
        if (request == EVIOCGBIT(EV_KEY, key_bytes)) {
            std::vector<std::byte> keys(key_bytes);
            keys[13] = std::byte{0x06};
            return {static_cast<int>(key_bytes), std::move(keys)};
        }
        if (request == EVIOCGKEY(key_bytes)) {
            return {static_cast<int>(key_bytes), std::vector<std::byte>(key_bytes)};
        }
        if (request == EVIOCGRAB) {
            if (held_by_another) {
                return {-EBUSY, {}};
            }
            grabbed += asked.has_argument() ? 1 : -1;
            return {};
        }
        return {-EINVAL, {}};
    }

    PluggedDevices device_{"P: /devices/virtual/input/input1/event1\nN: input/event1\n"
                           "E: DEVNAME=/dev/input/event1\nE: SUBSYSTEM=input\n\n",
                           "/dev/input/event1", [this](const Asked& asked) { return answer(asked); }};
};

TEST(KeyFiles, GrabsTheKeyboardExclusively) {
    Keyboard keyboard;
    const auto lines = open_key_lines({"/dev/input/event1", {105, 106}});
    ASSERT_TRUE(lines) << lines.error().message;
    EXPECT_EQ(keyboard.grabbed, 1);
}

TEST(KeyFiles, FindsAKeyboardByItsName) {
    Keyboard keyboard;
    EXPECT_TRUE(open_key_lines({"Bench", {105, 106}}));
    EXPECT_EQ(keyboard.grabbed, 1);
    for (const char* name : {"Bencher", "/dev/input/event2"}) {
        const auto lines = open_key_lines({name, {105, 106}});
        ASSERT_FALSE(lines) << name;
        EXPECT_EQ(lines.error().id, "panel.keyboard_lost") << lines.error().message;
    }
    EXPECT_EQ(keyboard.grabbed, 1) << "no other keyboard is kept";
}

TEST(KeyFiles, ReportsAKeyboardGrabbedByAnotherProgram) {
    Keyboard keyboard;
    keyboard.held_by_another = true;
    const auto lines = open_key_lines({"/dev/input/event1", {105, 106}});
    ASSERT_FALSE(lines);
    EXPECT_EQ(lines.error().kind, ErrorKind::DeviceLost);
    EXPECT_NE(lines.error().message.find("/dev/input/event1: another program has exclusive use of it"),
              std::string::npos)
        << lines.error().message;
    keyboard.held_by_another = false;
    EXPECT_TRUE(open_key_lines({"/dev/input/event1", {105, 106}}));
}

TEST(KeyFiles, DoesNotGrabAKeyboardWithoutTheKeys) {
    Keyboard keyboard;
    EXPECT_FALSE(open_key_lines({"/dev/input/event1", {105, 30}}));
    EXPECT_EQ(keyboard.grabbed, 0);
}

} // namespace
} // namespace frustumscreen::panel
