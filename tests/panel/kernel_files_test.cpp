// The panel's way to the kernel's files, which umockdev stands in for: a CP2112's hidraw device, a keyboard's
// event device, and their ioctls. Started by umockdev-wrapper.

#include "firmware_host/panel/cp2112.h"
#include "firmware_host/panel/key_lines.h"

#include <gtest/gtest.h>
#include <linux/hidraw.h>
#include <linux/input.h>
#include <umockdev.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <cstring>
#include <functional>
#include <string>
#include <vector>

namespace frustumscreen {
namespace {

/// What a device answers to one ioctl: its result, or minus an errno, and the bytes.
struct Answer {
    int result = 0;
    std::vector<std::byte> bytes;
};

/// A device as the kernel lists it in umockdev's words, whose ioctls a test answers; plugged in while it
/// lives.
class PluggedDevice {
public:
    using Answers = std::function<Answer(unsigned long request, bool argument)>;

    PluggedDevice(const std::string& listed, std::string node, Answers answers)
        : testbed_(umockdev_testbed_new()), node_(std::move(node)), answers_(std::move(answers)),
          handler_(umockdev_ioctl_base_new()) {
        EXPECT_TRUE(umockdev_testbed_add_from_string(testbed_, listed.c_str(), nullptr));
        g_signal_connect(handler_, "handle-ioctl", G_CALLBACK(&PluggedDevice::handle), this);
        EXPECT_TRUE(umockdev_testbed_attach_ioctl(testbed_, node_.c_str(), handler_, nullptr));
    }
    ~PluggedDevice() {
        umockdev_testbed_detach_ioctl(testbed_, node_.c_str(), nullptr);
        g_object_unref(handler_);
        g_object_unref(testbed_);
    }
    PluggedDevice(const PluggedDevice&) = delete;
    PluggedDevice& operator=(const PluggedDevice&) = delete;

private:
    static gboolean handle(UMockdevIoctlBase*, UMockdevIoctlClient* client, PluggedDevice* self) {
        const gulong request = umockdev_ioctl_client_get_request(client);
        UMockdevIoctlData* argument = umockdev_ioctl_client_get_arg(client);
        void* value = nullptr;
        std::memcpy(&value, argument->data, sizeof value);
        const Answer answer = self->answers_(request, value != nullptr);
        if (!answer.bytes.empty()) {
            UMockdevIoctlData* bytes = umockdev_ioctl_data_resolve(argument, 0, answer.bytes.size(), nullptr);
            std::memcpy(bytes->data, answer.bytes.data(), answer.bytes.size());
            g_object_unref(bytes);
        }
        umockdev_ioctl_client_complete(client, answer.result < 0 ? -1 : answer.result,
                                       answer.result < 0 ? -answer.result : 0);
        return TRUE;
    }

    UMockdevTestbed* testbed_;
    std::string node_;
    Answers answers_;
    UMockdevIoctlBase* handler_;
};

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

TEST(Cp2112Files, TheConfigurationIsReadThroughTheHidrawDeviceBesideTheGpioChip) {
    Answer answer{5, bytes_of({2, 0, 0xff, 3, 0})};
    const PluggedDevice chip(listed_chip(hid_device), "/dev/hidraw0", [&](unsigned long request, bool) {
        return request == HIDIOCGFEATURE(5) ? answer : Answer{-ENOTTY, {}};
    });
    EXPECT_EQ(read_cp2112_configuration("gpiochip2"), answer.bytes);
    EXPECT_TRUE(read_cp2112_configuration("gpiochip1").empty());
    answer.result = 4; // too short
    EXPECT_TRUE(read_cp2112_configuration("gpiochip2").empty());
    answer = {-EIO, {}}; // unplugged just now
    EXPECT_TRUE(read_cp2112_configuration("gpiochip2").empty());
}

TEST(Cp2112Files, AnotherChipIsNotAsked) {
    const std::string device = "/devices/platform/0003:10C4:EA91.0001";
    const PluggedDevice chip(listed_chip(device), "/dev/hidraw0", [&](unsigned long, bool) {
        ADD_FAILURE() << "nobody is to ask it";
        return Answer{5, bytes_of({2, 0, 0, 7, 0})};
    });
    EXPECT_TRUE(read_cp2112_configuration("gpiochip2").empty());
}

/// As where this user may not open it.
TEST(Cp2112Files, WhereTheHidrawDeviceCannotBeOpenedNothingIsSaid) {
    UMockdevTestbed* const testbed = umockdev_testbed_new();
    std::string listed = listed_chip(hid_device);
    listed.erase(listed.find("N: hidraw0"), std::strlen("N: hidraw0\n")); // there is no such file
    EXPECT_TRUE(umockdev_testbed_add_from_string(testbed, listed.c_str(), nullptr));
    EXPECT_TRUE(read_cp2112_configuration("gpiochip2").empty());
    g_object_unref(testbed);
}

/// A keyboard with the keys 105 and 106 that counts who keeps it to himself.
class Keyboard {
public:
    std::atomic<int> grabbed{0};
    std::atomic<bool> held_by_another{false};

private:
    Answer answer(unsigned long request, bool argument) {
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
            grabbed += argument ? 1 : -1;
            return {};
        }
        return {-EINVAL, {}};
    }

    PluggedDevice device_{"P: /devices/virtual/input/input1/event1\nN: input/event1\n"
                          "E: DEVNAME=/dev/input/event1\nE: SUBSYSTEM=input\n\n",
                          "/dev/input/event1",
                          [this](unsigned long request, bool argument) { return answer(request, argument); }};
};

TEST(KeyFiles, AKeyboardIsKeptFromEverybodyElse) {
    Keyboard keyboard;
    const auto lines = open_key_lines({"/dev/input/event1", {105, 106}});
    ASSERT_TRUE(lines) << lines.error().message;
    EXPECT_EQ(keyboard.grabbed, 1);
}

TEST(KeyFiles, AKeyboardThatAnotherProgramKeepsIsSaidInOneSentence) {
    Keyboard keyboard;
    keyboard.held_by_another = true;
    const auto lines = open_key_lines({"/dev/input/event1", {105, 106}});
    ASSERT_FALSE(lines);
    EXPECT_EQ(lines.error().kind, ErrorKind::DeviceLost);
    EXPECT_NE(lines.error().message.find("/dev/input/event1: another program keeps it to itself"),
              std::string::npos)
        << lines.error().message;
    keyboard.held_by_another = false;
    EXPECT_TRUE(open_key_lines({"/dev/input/event1", {105, 106}}));
}

TEST(KeyFiles, AKeyboardWithoutTheKeysIsLeftToOthers) {
    Keyboard keyboard;
    EXPECT_FALSE(open_key_lines({"/dev/input/event1", {105, 30}}));
    EXPECT_EQ(keyboard.grabbed, 0);
}

} // namespace
} // namespace frustumscreen
