/// A display that shows nothing and takes no time.
#pragma once

#include "firmware_host/display/display.h"

namespace frustumscreen::display {

class NoDisplay final : public Display {
public:
    [[nodiscard]] int width() const override { return 64; }
    [[nodiscard]] int height() const override { return 40; }
    [[nodiscard]] unsigned framebuffer() const override { return 0; }
    [[nodiscard]] int buffer_age() const override { return 1; }
    [[nodiscard]] Result<MonotonicTime> present(MonotonicTime now) override { return now; }
    [[nodiscard]] std::string name() const override { return "none"; }
};

} // namespace frustumscreen::display
