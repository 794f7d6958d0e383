#include "firmware_host/panel/cp2112.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <linux/hidraw.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <array>
#include <filesystem>

namespace frustumscreen::panel {

namespace {

namespace fs = std::filesystem;

constexpr std::byte report_number{0x02};
constexpr std::size_t report_bytes = 5;
constexpr std::size_t functions_byte = 3;

struct Function {
    unsigned pin;
    std::byte bit;
    std::string_view name;
};
constexpr std::array functions{Function{7, std::byte{1}, "its clock output"},
                               Function{0, std::byte{2}, "its TX toggle"},
                               Function{1, std::byte{4}, "its RX toggle"}};

bool is_configuration(std::span<const std::byte> bytes) {
    return bytes.size() >= report_bytes && bytes.front() == report_number;
}

/// In sysfs a GPIO chip is below its HID device, next to the device's hidraw.
fs::path hidraw_of(const std::string& gpio_chip) {
    std::error_code failed;
    const fs::path chip = fs::canonical(fs::path("/sys/bus/gpio/devices") / gpio_chip, failed);
    const fs::path device = chip.parent_path();
    if (failed || device.filename().string().find(":10C4:EA90.") == std::string::npos) {
        return {};
    }
    for (const auto& entry : fs::directory_iterator(device / "hidraw", failed)) {
        return "/dev" / entry.path().filename();
    }
    return {};
}

} // namespace

std::string_view cp2112_function(std::span<const std::byte> configuration, unsigned pin) {
    if (is_configuration(configuration)) {
        for (const Function& function : functions) {
            if (function.pin == pin && (configuration[functions_byte] & function.bit) != std::byte{0}) {
                return function.name;
            }
        }
    }
    return {};
}

std::string cp2112_remark(const std::string& chip, std::span<const std::byte> configuration,
                          std::span<const unsigned> buttons, std::span<const unsigned> lamps) {
    std::vector<std::string> found;
    const auto look = [&](std::span<const unsigned> lines, const char* setting) {
        for (const unsigned line : lines) {
            if (const std::string_view function = cp2112_function(configuration, line); !function.empty()) {
                found.push_back(fmt::format("line {} ({}) is {}", line, setting, function));
            }
        }
    };
    look(buttons, "panel.lines");
    look(lamps, "panel.lamps");
    return found.empty() ? std::string()
                         : fmt::format("GPIO chip {}: {}, not a GPIO line, until the chip is unplugged; name "
                                       "other lines: 2 to 6 have no such function",
                                       chip, fmt::join(found, ", "));
}

std::vector<std::byte> read_cp2112_configuration(const std::string& gpio_chip) {
    const fs::path path = hidraw_of(gpio_chip);
    const int file = path.empty() ? -1 : ::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
    if (file < 0) {
        return {};
    }
    std::vector<std::byte> report(report_bytes);
    report.front() = report_number;
    const int size = ::ioctl(file, HIDIOCGFEATURE(report_bytes), report.data());
    ::close(file);
    return size == static_cast<int>(report_bytes) && is_configuration(report) ? report
                                                                              : std::vector<std::byte>{};
}

} // namespace frustumscreen::panel
