// udev's events for graphics cards, through the real libudev. umockdev sends the events; kernel calls fail
// where a test sets it. Started by umockdev-wrapper.

#include "firmware_host/display/connector_watch.h"
#include "firmware_host/display/hotplug.h"

#include <dlfcn.h>
#include <gtest/gtest.h>
#include <sys/eventfd.h>
#include <sys/socket.h>
#include <umockdev.h>

#include <atomic>
#include <cerrno>
#include <filesystem>
#include <thread>

namespace {

/// Error numbers of failing calls; 0: calls the kernel.
struct Failing {
    int socket = 0, bind = 0, eventfd = 0;
    bool udev_new = false;
    int receive_once = 0;
};
std::atomic<Failing*> failing{nullptr};

template <typename Function> Function* real(const char* name) {
    return reinterpret_cast<Function*>(::dlsym(RTLD_NEXT, name));
}
int error_of(int Failing::*call) {
    const Failing* const now = failing;
    return now == nullptr ? 0 : now->*call;
}
int failed(int error) {
    errno = error;
    return -1;
}

} // namespace

extern "C" {

struct udev* udev_new() {
    const Failing* const now = failing;
    return now != nullptr && now->udev_new ? nullptr : real<struct udev*()>("udev_new")();
}
int socket(int domain, int type, int protocol) noexcept {
    const int error = domain == AF_NETLINK ? error_of(&Failing::socket) : 0;
    return error != 0 ? failed(error) : real<int(int, int, int)>("socket")(domain, type, protocol);
}
int bind(int file, const sockaddr* address, socklen_t size) noexcept {
    const int error = error_of(&Failing::bind);
    return error != 0 ? failed(error)
                      : real<int(int, const sockaddr*, socklen_t)>("bind")(file, address, size);
}
int eventfd(unsigned count, int flags) noexcept {
    const int error = error_of(&Failing::eventfd);
    return error != 0 ? failed(error) : real<int(unsigned, int)>("eventfd")(count, flags);
}
/// libudev uses it to query the length of the next event.
ssize_t recv(int file, void* bytes, size_t size, int flags) {
    Failing* const now = failing;
    if (const int error = now != nullptr ? std::exchange(now->receive_once, 0) : 0; error != 0) {
        return failed(error);
    }
    return real<ssize_t(int, void*, size_t, int)>("recv")(file, bytes, size, flags);
}
}

namespace frustumscreen::display {
namespace {

using std::chrono::milliseconds;
using std::chrono::minutes;
constexpr Nanoseconds at_once{0};

constexpr const char* card = "/sys/devices/pci0000:00/0000:00:02.0/drm/card0";
constexpr const char* stick = "/sys/devices/pci0000:00/usb1/1-1";

std::size_t open_descriptors() {
    const std::filesystem::directory_iterator all("/proc/self/fd");
    return static_cast<std::size_t>(std::distance(begin(all), end(all)));
}

class UdevHotplugTest : public ::testing::Test {
protected:
    UdevHotplugTest() {
        EXPECT_TRUE(umockdev_testbed_add_from_string(
            testbed,
            "P: /devices/pci0000:00/0000:00:02.0/drm/card0\nE: SUBSYSTEM=drm\nE: DEVTYPE=drm_minor\n\n"
            "P: /devices/pci0000:00/usb1/1-1\nE: SUBSYSTEM=usb\nE: DEVTYPE=usb_device\n\n",
            nullptr));
    }
    ~UdevHotplugTest() override {
        failing = nullptr;
        g_object_unref(testbed);
    }
    /// The event has arrived when this returns.
    void send(const char* device, const char* action) const {
        umockdev_testbed_uevent(testbed, device, action);
    }
    /// Receives no event, each wait takes its full time, and no descriptor leaks.
    static void is_deaf_but_patient(bool can_be_woken) {
        const std::size_t before = open_descriptors();
        {
            const std::unique_ptr<Hotplug> hotplug = make_udev_hotplug();
            for (int k = 0; k < 2; ++k) {
                const MonotonicTime begin = monotonic_now();
                EXPECT_FALSE(hotplug->wait(milliseconds(20)));
                EXPECT_GE(monotonic_now() - begin, milliseconds(20));
            }
            hotplug->wake();
            EXPECT_FALSE(hotplug->wait(can_be_woken ? Nanoseconds(minutes(10)) : at_once));
        }
        EXPECT_EQ(open_descriptors(), before);
    }

    UMockdevTestbed* testbed = umockdev_testbed_new();
    Failing faults;
};

TEST_F(UdevHotplugTest, ReportsEachChangeOfACardOnce) {
    const std::unique_ptr<Hotplug> hotplug = make_udev_hotplug();
    EXPECT_FALSE(hotplug->wait(at_once));
    for (const char* action : {"add", "change", "remove"}) {
        send(card, action);
        EXPECT_TRUE(hotplug->wait(minutes(10))) << action;
        EXPECT_FALSE(hotplug->wait(at_once)) << action;
    }
}

TEST_F(UdevHotplugTest, IgnoresOtherDevices) {
    const std::unique_ptr<Hotplug> hotplug = make_udev_hotplug();
    for (const char* action : {"add", "change", "remove"}) {
        send(stick, action);
        EXPECT_FALSE(hotplug->wait(at_once)) << action;
    }
    send(card, "change");
    EXPECT_TRUE(hotplug->wait(minutes(10)));
}

TEST_F(UdevHotplugTest, MergesABurstIntoOneEvent) {
    const std::unique_ptr<Hotplug> hotplug = make_udev_hotplug();
    for (int k = 0; k < 8; ++k) { // umockdev's queue holds ten
        send(card, "change");
    }
    EXPECT_TRUE(hotplug->wait(minutes(10)));
    EXPECT_FALSE(hotplug->wait(at_once));
}

TEST_F(UdevHotplugTest, ReportsAnOverflowingBurst) {
    const std::unique_ptr<Hotplug> hotplug = make_udev_hotplug();
    send(card, "change");
    faults.receive_once = ENOBUFS;
    failing = &faults;
    EXPECT_TRUE(hotplug->wait(minutes(10)));
    EXPECT_EQ(faults.receive_once, 0) << "libudev asks in another way";
    EXPECT_FALSE(hotplug->wait(at_once)) << "what had come is taken too";
}

TEST_F(UdevHotplugTest, AReceiveErrorIsNoEvent) {
    const std::unique_ptr<Hotplug> hotplug = make_udev_hotplug();
    send(card, "change");
    faults.receive_once = EIO;
    failing = &faults;
    EXPECT_FALSE(hotplug->wait(minutes(10)));
    EXPECT_TRUE(hotplug->wait(minutes(10))) << "it comes with the next wait";
}

TEST_F(UdevHotplugTest, WakesFromAnotherThreadWithoutAnEvent) {
    const std::unique_ptr<Hotplug> hotplug = make_udev_hotplug();
    for (int k = 0; k < 20; ++k) {
        std::thread other([&] { hotplug->wake(); }); // before or during the wait
        EXPECT_FALSE(hotplug->wait(minutes(10)));
        other.join();
        EXPECT_FALSE(hotplug->wait(at_once)) << "one call ends one wait";
    }
    hotplug->wake();
    send(card, "change");
    EXPECT_TRUE(hotplug->wait(minutes(10))) << "both at once";
}

TEST_F(UdevHotplugTest, ReportsNothingWithoutUdev) {
    failing = &faults;
    faults.udev_new = true;
    is_deaf_but_patient(true);
}

TEST_F(UdevHotplugTest, ReportsNothingWithoutASocket) {
    failing = &faults;
    faults.socket = EMFILE;
    is_deaf_but_patient(true);
}

TEST_F(UdevHotplugTest, ReportsNothingIfTheMonitorCannotListen) {
    failing = &faults;
    faults.bind = EPERM;
    is_deaf_but_patient(true);
}

TEST_F(UdevHotplugTest, WaitsEvenWithoutAnyDescriptor) {
    failing = &faults;
    faults.socket = EMFILE;
    faults.eventfd = EMFILE;
    is_deaf_but_patient(false);
}

TEST_F(UdevHotplugTest, ProbesALitCardAgainOnAUdevEvent) {
    std::atomic<int> thorough{0};
    std::atomic<int> cheap{0};
    ConnectorWatch watch(
        [&](bool thoroughly) {
            ++(thoroughly ? thorough : cheap);
            return CardSeen{};
        },
        make_udev_hotplug());
    watch.set_lit(true);
    while (cheap == 0) { // from then on it checks thoroughly only for a reason
        std::this_thread::sleep_for(milliseconds(1));
    }
    const int before = thorough;
    send(card, "change");
    while (thorough == before) { // ctest's timeout ends it
        std::this_thread::sleep_for(milliseconds(1));
    }
    EXPECT_EQ(thorough, before + 1);
}

} // namespace
} // namespace frustumscreen::display
