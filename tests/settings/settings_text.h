/// Texts of settings for the tests.
#pragma once

#include "app/settings/settings.h"
#include "tests/base/text_of.h"
#include "tests/base/told.h"
#include "tests/folders.h"

#include <gtest/gtest.h>

#include <string>

namespace frustumscreen::settings {

inline std::string shipped_text() {
    return frustumscreen::text_of(source_dir() + "/config/kiosk.toml");
}

inline Settings parsed(const std::string& text) {
    const auto settings = parse_settings(text, "set/kiosk.toml");
    EXPECT_TRUE(settings) << settings.error().message;
    return settings ? **settings : Settings();
}

/// The error message for `text`; empty if it was accepted.
inline std::string refusal(const std::string& text) {
    const auto settings = parse_settings(text, "set/kiosk.toml");
    if (settings) {
        return {};
    }
    EXPECT_EQ(settings.error().kind, ErrorKind::BadConfiguration);
    return test::told(settings.error());
}

} // namespace frustumscreen::settings
