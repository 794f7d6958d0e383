/// Keys of a keyboard in place of a panel's lines, for use on a desk: through the kernel's event devices
/// (evdev).
///
/// Threads and errors are those of ButtonLines. While the keyboard is open, it is grabbed: its keys reach no
/// console, and Ctrl-C has no effect.
#pragma once

#include "firmware_host/panel/button_lines.h"

namespace frustumscreen::panel {

struct KeyRequest {
    std::string device;               ///< a path, or the keyboard's name
    std::vector<std::uint16_t> codes; ///< of linux/input-event-codes.h, one for each button
};
[[nodiscard]] Result<std::unique_ptr<ButtonLines>> open_key_lines(const KeyRequest& request);

/// As above, for an open file, which it closes. `name` appears in messages.
[[nodiscard]] std::unique_ptr<ButtonLines> key_lines_over(int file, std::string name,
                                                          std::vector<std::uint16_t> codes);

/// Codes of names such as KEY_LEFT. Errors: BadConfiguration, an unknown name.
[[nodiscard]] Result<std::vector<std::uint16_t>> key_codes(std::span<const std::string> names);

} // namespace frustumscreen::panel
