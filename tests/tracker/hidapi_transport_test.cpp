// The path through hidapi and libudev to the kernel's files, which umockdev emulates: /sys, /dev/hidraw0 and
// its ioctls. Started by umockdev-wrapper.

#include "firmware_host/tracker/hidapi_transport.h"
#include "firmware_host/tracker/usb_tracker_driver.h"
#include "tests/base/comes_true.h"
#include "tests/tracker/bytes_in_document.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <umockdev.h>
#include <unistd.h>

#include <filesystem>
#include <optional>

namespace frustumscreen::tracker {
namespace {

const std::string node = "/dev/hidraw0";

std::string hex(const wire::Wire& bytes) {
    std::string text;
    for (const std::byte byte : bytes) {
        text += fmt::format("{:02X}", static_cast<unsigned>(byte));
    }
    return text;
}

/// A HID device with this descriptor that answers with this feature report; plugged in during its lifetime.
class PluggedDevice {
public:
    PluggedDevice(std::string_view vendor, std::string_view product, const wire::Wire& descriptor,
                  wire::Wire feature_report)
        : testbed_(umockdev_testbed_new()) {
        const std::string name = fmt::format("0003:{}:{}.0001", vendor, product);
        const std::string device = "/devices/virtual/misc/uhid/" + name;
        const std::string text =
            fmt::format("P: {0}/hidraw/hidraw0\nN: hidraw0\nE: DEVNAME={1}\nE: MAJOR=240\nE: MINOR=0\n"
                        "E: SUBSYSTEM=hidraw\nA: dev=240:0\\n\nL: device=../../../{2}\n\n"
                        "P: {0}\nE: SUBSYSTEM=hid\nE: HID_ID=0003:0000{3}:0000{4}\nE: HID_NAME=A device\n"
                        "E: HID_PHYS=\nE: HID_UNIQ=\nH: report_descriptor={5}\n\n",
                        device, node, name, vendor, product, hex(descriptor));
        EXPECT_TRUE(umockdev_testbed_add_from_string(testbed_, text.c_str(), nullptr));

        const std::size_t answered = feature_report.size();
        feature_report.resize(64);
        const auto size = static_cast<std::uint32_t>(descriptor.size());
        wire::Wire described;
        wire::put(described, size);
        const wire::Wire size_alone = described;
        described.insert(described.end(), descriptor.begin(), descriptor.end());
        described.resize(4 + 4096);
        std::string ioctls = fmt::format("@DEV {}\nHIDIOCGRDESCSIZE 0 {}\nHIDIOCGRDESC 0 {}\n", node,
                                         hex(size_alone), hex(described));
        if (answered > 0) {
            ioctls += fmt::format("HIDIOCGFEATURE {} {}\n", answered, hex(feature_report));
        }
        const std::filesystem::path file =
            std::filesystem::temp_directory_path() / fmt::format("frustumscreen_hid{}.ioctl", ::getpid());
        EXPECT_TRUE(write_file(file, as_bytes(ioctls)));
        EXPECT_TRUE(umockdev_testbed_load_ioctl(testbed_, node.c_str(), file.c_str(), nullptr));
        std::filesystem::remove(file);
    }
    ~PluggedDevice() {
        ::close(umockdev_testbed_get_dev_fd(testbed_, node.c_str())); // ends pending reads
        g_object_unref(testbed_);
    }
    PluggedDevice(const PluggedDevice&) = delete;
    PluggedDevice& operator=(const PluggedDevice&) = delete;

    void send(const wire::Wire& report) const {
        const int device = umockdev_testbed_get_dev_fd(testbed_, node.c_str());
        ASSERT_EQ(::write(device, report.data(), report.size()), static_cast<ssize_t>(report.size()));
    }

    /// Forbids opening the device; it stays visible.
    void forbid() const {
        gchar* root = umockdev_testbed_get_root_dir(testbed_);
        std::filesystem::permissions(root, std::filesystem::perms(0755));
        g_free(root);
        ASSERT_EQ(::chmod(node.c_str(), 0), 0);
    }

private:
    UMockdevTestbed* testbed_;
};

const wire::Wire space_mouse_descriptor =
    wire::from_hex("0501 0908 A101 8501 1600FE 26FF01 7510 9503 0930 0931 0932"
                   "8102 C0");

wire::Wire tracker_descriptor() {
    return wire::bytes_in_document("hid_tracker.md", "06 46 FF");
}

/// Passes as the test says: a step that takes long is no silence of the device.
struct SimulatedClock {
    MonotonicTime now{std::chrono::seconds(100)};
    UsbTrackerDriver::Clock clock() {
        return [this] { return now; };
    }
};

wire::Wire pose(std::uint32_t counter) {
    wire::HidPose sent;
    sent.counter = counter;
    sent.time_us = 1000 * counter;
    sent.position[0] = static_cast<std::int32_t>(counter);
    return wire::hid_pose(sent);
}

TEST(HidapiTransport, FindsATrackerByUsageAndReconnectsAfterUnplugging) {
    SimulatedClock time;
    UsbTrackerDriver driver(make_hid_bus(UsbTrackerModel::Hid), {}, time.clock());
    std::vector<PoseSample> samples;
    EXPECT_GT(driver.step(samples), Nanoseconds::zero());
    EXPECT_EQ(driver.state(), UsbTrackerState::NotConnected);
    std::uint32_t counter = 0;
    for (int round = 0; round < 3; ++round) {
        std::optional<PluggedDevice> device;
        device.emplace("1209", "0001", tracker_descriptor(), wire::hid_info());
        EXPECT_EQ(driver.step(samples), Nanoseconds::zero()); // opened immediately
        EXPECT_EQ(driver.state(), UsbTrackerState::SettingUp);
        EXPECT_EQ(driver.step(samples), Nanoseconds::zero()); // the feature report
        samples.clear();
        for (std::size_t k = 1; k <= 5; ++k) {
            time.now += std::chrono::milliseconds(1);
            device->send(pose(++counter));
            // The kernel may deliver it only after the time that a read waits.
            ASSERT_TRUE(comes_true([&] {
                EXPECT_EQ(driver.step(samples), Nanoseconds::zero());
                return samples.size() == k;
            }));
        }
        EXPECT_NEAR(samples.back().position_m.x, 1e-5 * counter, 1e-12);
        EXPECT_EQ(driver.state(), UsbTrackerState::Streaming);
        EXPECT_EQ(driver.step(samples), Nanoseconds::zero()); // no data: no harm
        device.reset();
        EXPECT_GT(driver.step(samples), Nanoseconds::zero());
        EXPECT_EQ(driver.state(), UsbTrackerState::NotConnected);
        EXPECT_GT(driver.step(samples), Nanoseconds::zero());
        EXPECT_EQ(driver.state(), UsbTrackerState::NotConnected);
    }
}

TEST(HidapiTransport, RejectsADeviceWithoutItsFeatureReport) {
    const PluggedDevice device("1209", "0001", tracker_descriptor(), {});
    UsbTrackerDriver driver(make_hid_bus(UsbTrackerModel::Hid), {}, monotonic_now);
    std::vector<PoseSample> samples;
    EXPECT_GT(driver.step(samples), Nanoseconds::zero());
    EXPECT_EQ(driver.state(), UsbTrackerState::SetUpRefused);
}

/// Runs in a child process as the user `nobody`, because root may open everything.
TEST(HidapiTransport, ReportsMissingPermission) {
    const PluggedDevice device("1209", "0001", tracker_descriptor(), wire::hid_info());
    device.forbid();
    const auto search = [] {
        constexpr unsigned nobody = 65534;
        if (::geteuid() == 0 && ::setuid(nobody) != 0) {
            ::_exit(255);
        }
        const auto found = make_hid_bus(UsbTrackerModel::Hid)->find({});
        ::_exit(found ? 254 : static_cast<int>(found.error()));
    };
    EXPECT_EXIT(search(), ::testing::ExitedWithCode(static_cast<int>(UsbTrackerState::NoPermission)), "");
}

TEST(HidapiTransport, FindsASpaceMouseOnlyOnItsOwnBus) {
    const PluggedDevice device("256F", "C635", space_mouse_descriptor, {});
    EXPECT_EQ(make_hid_bus(UsbTrackerModel::Hid)->find({}).error(), UsbTrackerState::NotConnected);
    SimulatedClock time;
    UsbTrackerDriver driver(make_hid_bus(UsbTrackerModel::SpaceMouse), {}, time.clock());
    std::vector<PoseSample> samples;
    EXPECT_EQ(driver.step(samples), Nanoseconds::zero());
    ASSERT_TRUE(comes_true([&] {
        time.now += std::chrono::milliseconds(10);
        device.send(wire::space_mouse(1, {350, 0, 0}));
        EXPECT_EQ(driver.step(samples), Nanoseconds::zero());
        return !samples.empty() && samples.back().position_m.x > 0.0;
    }));
    EXPECT_EQ(driver.state(), UsbTrackerState::Streaming);
    EXPECT_GT(samples.size(), 1U);
}

TEST(HidapiTransport, IgnoresASpaceMouseLookalikeOfAnotherVendor) {
    const PluggedDevice device("045E", "C635", space_mouse_descriptor, {});
    EXPECT_EQ(make_hid_bus(UsbTrackerModel::SpaceMouse)->find({}).error(), UsbTrackerState::NotConnected);
}

} // namespace
} // namespace frustumscreen::tracker
