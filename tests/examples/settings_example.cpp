// The settings file becomes one checked struct. A missing key has its default, and the error for a mistyped
// key names the nearest known one.
#include "app/settings/settings.h"

#include <gtest/gtest.h>

namespace frustumscreen::example {
namespace {

TEST(RoomExample, Settings) {
    // example
    const settings::CheckedSettings settings =
        settings::parse_settings("[prop]\nheight_m = 0.2\n", "kiosk.toml").value();
    EXPECT_EQ(settings->prop.height_m, 0.2);
    EXPECT_EQ(settings->prop.base_m, 0.30); // as shipped

    const Error error = settings::parse_settings("[prop]\nheigth_m = 0.2\n", "kiosk.toml").error();
    EXPECT_NE(error.message.find("kiosk.toml"), std::string::npos);
    EXPECT_NE(error.message.find("height_m"), std::string::npos) << error.message; // the nearest known key
    // end
}

} // namespace
} // namespace frustumscreen::example
