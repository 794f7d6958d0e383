/// Special functions of the pins of a CP2112, a USB bridge that is often a panel's GPIO chip.
///
/// Three of its eight pins have a special function. Linux' hid-cp2112 sets directions and leaves the rest of
/// the chip's configuration unchanged. A pin whose function another program has switched on is not a GPIO
/// until the chip loses its power, although the kernel offers it as one.
///
/// Bytes    feature report 0x02: its number; a bit per pin for output, and one for push-pull; the active
///          functions: bit 0 pin 7's clock output, bit 1 pin 0's TX toggle, bit 2 pin 1's RX toggle; the
///          clock's divider.
/// Source   Silicon Labs, AN495 'CP2112 Interface Specification', section 4.2 and table 2 (the configuration
///          is in RAM); the bits also in FreeBSD's sys/dev/usb/misc/cp2112.c, 06862de5.
/// Threads  any; `read_cp2112_configuration` blocks until the chip answers.
/// Errors   none: an unreadable configuration is not reported.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace frustumscreen::panel {

/// The special function of this pin; empty: it is a GPIO, or the bytes are not such a report.
[[nodiscard]] std::string_view cp2112_function(std::span<const std::byte> configuration, unsigned pin);

/// One sentence that names the panel's lines that are not GPIOs, and what to do; empty: all are. `chip` as in
/// the settings; `buttons` and `lamps` are offsets.
[[nodiscard]] std::string cp2112_remark(const std::string& chip, std::span<const std::byte> configuration,
                                        std::span<const unsigned> buttons, std::span<const unsigned> lamps);

/// The configuration report of the CP2112 with this GPIO chip, such as "gpiochip0", through its hidraw
/// device. Empty: no such chip, not a CP2112, no answer, or no permission.
[[nodiscard]] std::vector<std::byte> read_cp2112_configuration(const std::string& gpio_chip);

} // namespace frustumscreen::panel
