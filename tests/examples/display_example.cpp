// A picture is drawn into the display's framebuffer and then presented. A projector and a test use the same
// interface.
#include "firmware_host/display/surfaceless_display.h"

#include <gtest/gtest.h>

#include <array>
#include <memory>

namespace frustumscreen::example {
namespace {

TEST(RoomExample, Display) {
    // example
    const std::unique_ptr<display::Display> display = display::SurfacelessDisplay::create(64, 40).value();
    glBindFramebuffer(GL_FRAMEBUFFER, display->framebuffer());
    glClearColor(0.5F, 0.0F, 0.0F, 1.0F); // linear light
    glClear(GL_COLOR_BUFFER_BIT);
    EXPECT_EQ(display->present(MonotonicTime{}).value(), MonotonicTime{}); // when it is lit
    EXPECT_EQ(display->buffer_age(), 1);                                   // it holds the latest picture

    std::array<std::uint8_t, 4> pixel{};
    glReadPixels(0, 0, 1, 1, GL_RGBA, GL_UNSIGNED_BYTE, pixel.data());
    EXPECT_EQ(pixel[0], 188); // the sRGB code of 0.5: 255 (1.055 * 0.5^(1 / 2.4) - 0.055)
    // end
}

} // namespace
} // namespace frustumscreen::example
