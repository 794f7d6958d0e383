#include "firmware_host/display/hotplug.h"

#include <poll.h>
#include <sys/eventfd.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <cstdint>

extern "C" {
#include <libudev.h>
}

namespace frustumscreen::display {

namespace {

using Udev = std::unique_ptr<udev, udev* (*)(udev*)>;
using Monitor = std::unique_ptr<udev_monitor, udev_monitor* (*)(udev_monitor*)>;
using Device = std::unique_ptr<udev_device, udev_device* (*)(udev_device*)>;

class UdevHotplug final : public Hotplug {
public:
    UdevHotplug() : wake_(::eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK)) {
        if (udev_ != nullptr) {
            monitor_.reset(udev_monitor_new_from_netlink(udev_.get(), "udev"));
        }
        if (monitor_ != nullptr &&
            (udev_monitor_filter_add_match_subsystem_devtype(monitor_.get(), "drm", nullptr) < 0 ||
             udev_monitor_enable_receiving(monitor_.get()) < 0)) {
            monitor_.reset();
        }
    }
    ~UdevHotplug() override { ::close(wake_); }
    UdevHotplug(const UdevHotplug&) = delete;
    UdevHotplug& operator=(const UdevHotplug&) = delete;

    [[nodiscard]] bool wait(Nanoseconds at_most) override {
        std::array<pollfd, 2> files{{{wake_, POLLIN, 0}, {-1, POLLIN, 0}}};
        if (monitor_ != nullptr) {
            files[1].fd = udev_monitor_get_fd(monitor_.get());
        }
        const auto ms = std::chrono::ceil<std::chrono::milliseconds>(at_most).count();
        if (::poll(files.data(), files.size(), static_cast<int>(ms)) <= 0) {
            return false;
        }
        if (files[0].revents != 0) {
            std::uint64_t count = 0;
            static_cast<void>(!::read(wake_, &count, sizeof count));
        }
        bool heard = false;
        while (monitor_ != nullptr && files[1].revents != 0 && (came() || some_were_lost())) {
            heard = true;
        }
        return heard;
    }

    void wake() override {
        const std::uint64_t one = 1;
        static_cast<void>(!::write(wake_, &one, sizeof one));
    }

private:
    [[nodiscard]] bool came() const {
        return Device(udev_monitor_receive_device(monitor_.get()), udev_device_unref) != nullptr;
    }
    /// The kernel lacked memory for an event, or its queue overflowed: netlink(7).
    [[nodiscard]] static bool some_were_lost() { return errno == ENOBUFS; }

    int wake_;
    Udev udev_{udev_new(), udev_unref};
    Monitor monitor_{nullptr, udev_monitor_unref};
};

} // namespace

std::unique_ptr<Hotplug> make_udev_hotplug() {
    return std::make_unique<UdevHotplug>();
}

} // namespace frustumscreen::display
