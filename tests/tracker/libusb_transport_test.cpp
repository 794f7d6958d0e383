// The path through libusb and libudev to the kernel's files, which umockdev emulates: /sys and /dev/bus/usb.
// Started by umockdev-wrapper. Tests only finding and opening, no transfers.

#include "firmware_host/tracker/composite_bus.h"
#include "firmware_host/tracker/libusb_transport.h"
#include "tests/tracker/fixture.h"

#include <fmt/format.h>
#include <linux/usbdevice_fs.h>
#include <sys/ioctl.h>
#include <umockdev.h>

#include <atomic>
#include <cerrno>

namespace frustumscreen::tracker {
namespace {

const wire::Fixture descriptors("descriptors.txt");

std::string hex(const wire::Wire& bytes) {
    std::string text;
    for (const std::byte byte : bytes) {
        text += fmt::format("{:02X}", static_cast<unsigned>(byte));
    }
    return text;
}

/// The kernel's view of the devices at its ports.
class UsbPorts {
public:
    UsbPorts() : testbed_(umockdev_testbed_new()) {}
    ~UsbPorts() { g_object_unref(testbed_); }
    UsbPorts(const UsbPorts&) = delete;
    UsbPorts& operator=(const UsbPorts&) = delete;

    /// Plugs in a VIPER with its device descriptor and these descriptors after it; `configuration` is the
    /// kernel's choice.
    void plug(int port, const std::string& name, const std::string& configuration = "1") {
        wire::Wire all = descriptors["device"];
        const wire::Wire more = descriptors[name];
        all.insert(all.end(), more.begin(), more.end());
        const std::string node = fmt::format("bus/usb/001/{:03}", port);
        const std::string text =
            fmt::format("P: /devices/usb1/1-{0}\nN: {1}\nE: DEVNAME=/dev/{1}\nE: DEVTYPE=usb_device\n"
                        "E: SUBSYSTEM=usb\nE: BUSNUM=001\nE: DEVNUM={0:03}\nE: MAJOR=189\nE: MINOR={0}\n"
                        "A: busnum=1\\n\nA: devnum={0}\\n\nA: speed=12\\n\nA: bConfigurationValue={2}\\n\n"
                        "H: descriptors={3}\n\n",
                        port, node, configuration, hex(all));
        EXPECT_TRUE(umockdev_testbed_add_from_string(testbed_, text.c_str(), nullptr));
        UMockdevIoctlBase* calls = umockdev_ioctl_base_new();
        g_signal_connect(calls, "handle-ioctl", G_CALLBACK(answer), &claim_error);
        EXPECT_TRUE(umockdev_testbed_attach_ioctl(testbed_, ("/dev/" + node).c_str(), calls, nullptr));
        g_object_unref(calls);
    }

    std::atomic<int> claim_error{0}; ///< errno of the next claim of an interface; 0: succeeds

private:
    /// On umockdev's thread. Every call succeeds without data, except a claim that must fail.
    static gboolean answer(UMockdevIoctlBase* /*calls*/, UMockdevIoctlClient* client, gpointer claim_error) {
        const gulong request = umockdev_ioctl_client_get_request(client);
        const bool claims = request == USBDEVFS_CLAIMINTERFACE || request == USBDEVFS_DISCONNECT_CLAIM;
        const int error = claims ? static_cast<std::atomic<int>*>(claim_error)->load() : 0;
        umockdev_ioctl_client_complete(client, error == 0 ? 0 : -1, error);
        return TRUE;
    }

    UMockdevTestbed* testbed_;
};

TEST(LibusbTransport, ReportsNotConnectedWithoutATracker) {
    const UsbPorts ports;
    EXPECT_EQ(make_libusb_bus()->find({}).error(), UsbTrackerState::NotConnected);
}

TEST(LibusbTransport, AViperIsFoundAndOpened) {
    UsbPorts ports;
    ports.plug(3, "good");
    const auto bus = make_libusb_bus(); // outlives the trackers it finds
    const auto found = bus->find({});
    ASSERT_TRUE(found) << sentence_of(found.error());
    EXPECT_EQ(found->model, UsbTrackerModel::Viper);
    EXPECT_EQ(found->place, "usb 1-3");
}

TEST(LibusbTransport, SkipsADeviceWithHostileDescriptors) {
    for (const std::string name : {"no-endpoints", "absurd-endpoints", "absurd-lengths"}) {
        UsbPorts ports;
        ports.plug(2, name);
        const auto hostile = make_libusb_bus()->find({});
        ASSERT_FALSE(hostile) << name;
        EXPECT_EQ(hostile.error(), UsbTrackerState::CannotBeOpened) << name;
        ports.plug(3, "good");
        const auto bus = make_libusb_bus();
        const auto found = bus->find({});
        ASSERT_TRUE(found) << name;
        EXPECT_EQ(found->place, "usb 1-3") << name;
    }
}

TEST(LibusbTransport, ReportsAnUnconfiguredDeviceAsNotOpenable) {
    UsbPorts ports;
    ports.plug(2, "good", "");
    EXPECT_EQ(make_libusb_bus()->find({}).error(), UsbTrackerState::CannotBeOpened);
}

TEST(LibusbTransport, ReportsClaimErrorsAndRecovers) {
    UsbPorts ports;
    ports.plug(2, "good");
    for (const auto& [error, state] :
         {std::pair(EIO, UsbTrackerState::CannotBeOpened), std::pair(EBUSY, UsbTrackerState::InUse),
          std::pair(ENODEV, UsbTrackerState::NotConnected)}) {
        ports.claim_error = error;
        EXPECT_EQ(make_libusb_bus()->find({}).error(), state) << error;
    }
    ports.claim_error = 0;
    EXPECT_TRUE(make_libusb_bus()->find({}));
}

TEST(LibusbTransport, SkipsExcludedPlacesOnEveryBus) {
    UsbPorts ports;
    ports.plug(2, "good");
    ports.plug(3, "good");
    std::vector<std::unique_ptr<UsbBus>> buses;
    buses.push_back(make_libusb_bus());
    buses.push_back(make_libusb_bus());
    CompositeBus bus(std::move(buses));
    const auto place = [&bus](const std::vector<std::string>& but_not) {
        const auto found = bus.find(but_not);
        return found ? found->place : std::string(sentence_of(found.error()));
    };
    EXPECT_NE(place({}), place({place({})}));
    EXPECT_EQ(place({"usb 1-2"}), "usb 1-3");
    EXPECT_EQ(place({"usb 1-3"}), "usb 1-2");
    EXPECT_EQ(place({"usb 1-2", "usb 1-3"}), sentence_of(UsbTrackerState::NotConnected));
}

} // namespace
} // namespace frustumscreen::tracker
