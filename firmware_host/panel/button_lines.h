/// The lines of a button panel: their levels, and waiting for a change.
///
/// Threads  the opening thread; `wait` blocks it.
/// Errors   DeviceLost: the chip is gone, or not there yet; the message is a sentence for a technician.
#pragma once

#include "firmware_host/base/line_bias.h"
#include "firmware_host/base/result.h"
#include "firmware_host/base/time.h"

#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace frustumscreen::panel {

class ButtonLines {
public:
    virtual ~ButtonLines() = default;
    /// True = down, one for each line.
    [[nodiscard]] virtual Result<void> read(std::span<bool> down) = 0;
    /// Waits until a level changes, at most `timeout`.
    [[nodiscard]] virtual Result<void> wait(Nanoseconds timeout) = 0;
    /// True = lit, one for each button; buttons without a lamp ignore it.
    [[nodiscard]] virtual Result<void> light(std::span<const bool> /*lit*/) { return {}; }
    /// A fault of open lines in one sentence for a technician; empty: no fault.
    [[nodiscard]] virtual std::string_view remark() const { return {}; }
};

struct LineRequest {
    std::string chip;               ///< path, name, label or number
    std::vector<std::string> lines; ///< names, or offsets in digits; one for each button
    LineBias bias = LineBias::PullUp;
    bool active_low = true;              ///< a pressed button pulls its line to ground
    std::vector<std::string> lamps = {}; ///< as `lines`; in the order of the buttons, one for each
};
/// Uses libgpiod 1.6, the version in Debian 12; libgpiod 2 needs another file with this function.
[[nodiscard]] Result<std::unique_ptr<ButtonLines>> open_gpio_lines(const LineRequest& request);

using OpenLines = std::function<Result<std::unique_ptr<ButtonLines>>()>;

} // namespace frustumscreen::panel
