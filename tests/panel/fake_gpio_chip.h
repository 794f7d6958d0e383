// A GPIO chip of linux/gpio.h, a CP2112, with ioctls answered through umockdev.
#pragma once

#include "tests/panel/plugged_devices.h"

#include <fcntl.h>
#include <linux/gpio.h>
#include <linux/hidraw.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <deque>
#include <filesystem>
#include <mutex>
#include <optional>

namespace frustumscreen::panel {

template <typename Struct> Answer answer_with(const Struct& value) {
    const auto* const bytes = reinterpret_cast<const std::byte*>(&value);
    return {0, {bytes, bytes + sizeof value}};
}

/// A CP2112 with eight lines, L0 to L7. With trouble set, each later ioctl fails with its errno.
class GpioChip {
public:
    static constexpr std::uint32_t line_count = 8;

    GpioChip() : devices_(listed()) {
        devices_.answer("/dev/gpiochip2", [this](const Asked& asked) { return of_chip(asked); });
        devices_.answer("/dev/gpio-request", [this](const Asked& asked) { return of_request(asked); });
        devices_.answer("/dev/hidraw0", [this](const Asked& asked) {
            return asked.request() == HIDIOCGFEATURE(5) ? Answer{5, configuration} : Answer{-ENOTTY, {}};
        });
    }
    ~GpioChip() {
        for (const int file : spare_) {
            ::close(file);
        }
    }
    GpioChip(const GpioChip&) = delete;
    GpioChip& operator=(const GpioChip&) = delete;

    /// A request of lines has its own descriptor, which the kernel creates. umockdev answers ioctls only on
    /// files that this thread opened, so the descriptors for an opening of the chip are opened in advance:
    /// one for the buttons, one for their lamps.
    void expect_opening(int requests = 2) {
        const std::lock_guard lock(mutex_);
        for (int k = 0; k < requests; ++k) {
            spare_.push_back(::open("/dev/gpio-request", O_RDWR | O_CLOEXEC));
        }
    }
    void set_trouble(int error, unsigned long request = 0) {
        const std::lock_guard lock(mutex_);
        trouble_ = error;
        trouble_with_ = request;
    }
    void set_levels(std::initializer_list<int> levels) {
        const std::lock_guard lock(mutex_);
        std::copy(levels.begin(), levels.end(), levels_.begin());
    }
    /// Open descriptors of its files, except those opened in advance.
    [[nodiscard]] std::size_t left_open() {
        std::size_t count = 0;
        for (const auto& entry : std::filesystem::directory_iterator("/proc/self/fd")) {
            std::error_code closed; // the descriptor of the listing itself
            const std::string file = std::filesystem::read_symlink(entry.path(), closed).filename();
            count += file == "gpiochip2" || file == "gpio-request" || file == "hidraw0" ? 1 : 0;
        }
        const std::lock_guard lock(mutex_);
        return count - spare_.size();
    }
    [[nodiscard]] std::vector<int> lamps() {
        const std::lock_guard lock(mutex_);
        return lamps_;
    }
    /// The latest request for input lines, or for lamps.
    [[nodiscard]] gpiohandle_request requested(bool lamps) {
        const std::lock_guard lock(mutex_);
        return lamps ? lamps_request_ : lines_request_;
    }

    std::vector<std::byte> configuration{std::byte{2}, std::byte{0}, std::byte{0}, std::byte{0},
                                         std::byte{0}};

private:
    static std::string listed() {
        const std::string device = "/devices/pci0000:00/usb1/1-1/1-1:1.0/0003:10C4:EA90.0001";
        // The nodes are files, not umockdev's terminals: libgpiod refuses links there.
        return "P: " + device + "/gpiochip2\nN: gpiochip2=00\nE: DEVNAME=/dev/gpiochip2\n" +
               "E: SUBSYSTEM=gpio\nE: MAJOR=254\nE: MINOR=2\nA: dev=254:2\\n\n\n" + "P: " + device +
               "/hidraw/hidraw0\nN: hidraw0=00\nE: DEVNAME=/dev/hidraw0\nE: SUBSYSTEM=hidraw\n\n" +
               "P: " + device + "\nE: SUBSYSTEM=hid\n\n" +
               "P: /devices/virtual/gpio-request\nN: gpio-request=00\nE: DEVNAME=/dev/gpio-request\n"
               "E: SUBSYSTEM=gpio-request\n\n";
    }
    std::optional<Answer> trouble_of(const Asked& asked) const {
        const bool fails = trouble_ != 0 && (trouble_with_ == 0 || trouble_with_ == asked.request());
        return fails ? std::optional(Answer{-trouble_, {}}) : std::nullopt;
    }
    Answer of_chip(const Asked& asked) {
        const std::lock_guard lock(mutex_);
        if (const std::optional<Answer> trouble = trouble_of(asked)) {
            return *trouble;
        }
        switch (asked.request()) {
        case GPIO_GET_CHIPINFO_IOCTL:
            return answer_with(gpiochip_info{"gpiochip2", "CP2112", line_count});
        case GPIO_GET_LINEINFO_IOCTL: {
            auto line = asked.argument<gpioline_info>();
            if (line.line_offset >= line_count) {
                return {-EINVAL, {}};
            }
            line.name[0] = 'L';
            line.name[1] = static_cast<char>('0' + line.line_offset);
            return answer_with(line);
        }
        case GPIO_GET_LINEHANDLE_IOCTL: {
            auto wish = asked.argument<gpiohandle_request>();
            const bool output = (wish.flags & GPIOHANDLE_REQUEST_OUTPUT) != 0;
            (output ? lamps_request_ : lines_request_) = wish;
            if (spare_.empty()) {
                return {-EMFILE, {}};
            }
            wish.fd = spare_.front();
            spare_.pop_front();
            if (output) {
                lamps_.assign(wish.default_values, wish.default_values + wish.lines);
            }
            return answer_with(wish);
        }
        default:
            return {-ENOTTY, {}};
        }
    }
    Answer of_request(const Asked& asked) {
        const std::lock_guard lock(mutex_);
        if (const std::optional<Answer> trouble = trouble_of(asked)) {
            return *trouble;
        }
        if (asked.request() == GPIOHANDLE_GET_LINE_VALUES_IOCTL) {
            gpiohandle_data values{};
            for (std::size_t k = 0; k < lines_request_.lines; ++k) {
                values.values[k] = static_cast<std::uint8_t>(levels_.at(lines_request_.lineoffsets[k]));
            }
            return answer_with(values);
        }
        if (asked.request() == GPIOHANDLE_SET_LINE_VALUES_IOCTL) {
            const auto values = asked.argument<gpiohandle_data>();
            lamps_.assign(values.values, values.values + lamps_request_.lines);
            return {};
        }
        return {-ENOTTY, {}};
    }

    std::mutex mutex_;
    int trouble_ = 0;
    unsigned long trouble_with_ = 0; ///< 0: every request
    std::array<int, line_count> levels_{};
    std::vector<int> lamps_;
    gpiohandle_request lines_request_{}, lamps_request_{};
    std::deque<int> spare_;
    PluggedDevices devices_;
};

} // namespace frustumscreen::panel
