#include "firmware_host/base/file.h"
#include "firmware_host/panel/cp2112.h"
#include "tests/folders.h"

#include <gtest/gtest.h>

#include <array>
#include <sstream>

namespace frustumscreen::panel {
namespace {

/// A configuration from independent sources, and the pins that it removes from GPIO.
struct Known {
    std::vector<std::byte> bytes;
    std::vector<unsigned> pins;
};

/// Read from the file that also tests the mock.
std::vector<Known> known_configurations() {
    const auto file = read_file(source_dir() + "/tests/hil/mock_tests/cp2112_reports.txt");
    std::istringstream lines(file ? std::string(as_text(*file)) : std::string());
    std::vector<Known> found;
    for (std::string line; std::getline(lines, line);) {
        std::istringstream words(line.substr(0, line.find('#')));
        std::string word;
        if (!(words >> word) || word != "functions") {
            continue;
        }
        Known known;
        while (words >> word && word != "=") {
            known.bytes.push_back(static_cast<std::byte>(std::stoul(word, nullptr, 16)));
        }
        for (unsigned pin = 0; words >> pin;) {
            known.pins.push_back(pin);
        }
        found.push_back(std::move(known));
    }
    return found;
}

TEST(Cp2112, PinFunctionsMatchKnownConfigurations) {
    const std::vector<Known> configurations = known_configurations();
    ASSERT_EQ(configurations.size(), 5U);
    for (const Known& known : configurations) {
        std::vector<unsigned> found;
        for (unsigned pin = 0; pin < 8; ++pin) {
            if (!cp2112_function(known.bytes, pin).empty()) {
                found.push_back(pin);
            }
        }
        EXPECT_EQ(found, known.pins);
    }
}

TEST(Cp2112, IgnoresOtherAndTruncatedReports) {
    const std::array<std::byte, 5> all{std::byte{2}, std::byte{0}, std::byte{0}, std::byte{7}, std::byte{0}};
    std::array<std::byte, 5> another = all;
    another[0] = std::byte{3};
    EXPECT_EQ(cp2112_function(all, 0), "its TX toggle");
    EXPECT_EQ(cp2112_function(all, 8), "");
    EXPECT_EQ(cp2112_function(another, 0), "") << "another report";
    for (std::size_t size = 0; size < all.size(); ++size) {
        EXPECT_EQ(cp2112_function(std::span(all).first(size), 0), "") << "too short";
    }
}

TEST(Cp2112, RemarkNamesNumberSettingAndFunctionOfALine) {
    const std::array<std::byte, 5> clock_and_light{std::byte{2}, std::byte{0}, std::byte{0xff}, std::byte{3},
                                                   std::byte{1}};
    const std::array<unsigned, 3> buttons{4, 5, 7};
    const std::array<unsigned, 2> lamps{2, 0};
    EXPECT_EQ(
        cp2112_remark("cp2112_gpio", clock_and_light, buttons, lamps),
        "GPIO chip cp2112_gpio: line 7 (panel.lines) is its clock output, line 0 (panel.lamps) is its TX "
        "toggle, not a GPIO line, until the chip is unplugged; name other lines: 2 to 6 have no such "
        "function");
    EXPECT_EQ(cp2112_remark("cp2112_gpio", clock_and_light, std::span(buttons).first(2), {}), "");
    EXPECT_EQ(cp2112_remark("cp2112_gpio", {}, buttons, lamps), "") << "nothing was read";
}

TEST(Cp2112, MissingOrOtherChipHasNoConfiguration) {
    EXPECT_TRUE(read_cp2112_configuration("no-such-chip").empty());
    EXPECT_TRUE(read_cp2112_configuration("../../usb/devices").empty());
}

} // namespace
} // namespace frustumscreen::panel
