/// What the pins of a CP2112, a USB bridge that is often a panel's GPIO chip, do besides GPIO.
///
/// Three of its eight pins have a special function. Linux' hid-cp2112 sets directions and leaves the rest of
/// the chip's configuration as it is: a pin whose function another program has switched on is no GPIO until
/// the chip loses its power, although the kernel offers it as one.
///
/// Bytes    feature report 0x02: its number; a bit each pin for output and for push-pull; the functions that
///          are on: bit 0 pin 7's clock output, bit 1 pin 0's TX toggle, bit 2 pin 1's RX toggle; the
///          clock's divider.
/// Source   Silicon Labs, AN495 'CP2112 Interface Specification', section 4.2 and table 2 (the configuration
///          is in RAM); the bits also in FreeBSD's sys/dev/usb/misc/cp2112.c, 06862de5.
/// Threads  any; `read_cp2112_configuration` blocks for as long as the chip takes to answer.
/// Errors   none: what cannot be read is not reported.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace frustumscreen {

/// The function that this pin has instead of GPIO; empty: it is GPIO, or the bytes are no such report.
[[nodiscard]] std::string_view cp2112_function(std::span<const std::byte> configuration, unsigned pin);

/// In one sentence, which of a panel's lines are no GPIO and what to do; empty: all are. `chip` as in the
/// settings; `buttons` and `lamps` are offsets.
[[nodiscard]] std::string cp2112_remark(const std::string& chip, std::span<const std::byte> configuration,
                                        std::span<const unsigned> buttons, std::span<const unsigned> lamps);

/// The report of the CP2112 that is the GPIO chip of this name, such as "gpiochip0", through its hidraw
/// device. Empty: the chip has none, is no CP2112, does not answer, or this user may not open it.
[[nodiscard]] std::vector<std::byte> read_cp2112_configuration(const std::string& gpio_chip);

} // namespace frustumscreen
