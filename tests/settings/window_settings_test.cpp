// The table [windows]: every key, and windows that fit on the lit table.
#include "app/settings/command.h"
#include "app/settings/config_json.h"
#include "app/settings/lit_zone.h"
#include "firmware_host/base/json.h"
#include "tests/settings/settings_text.h"

#include <fmt/format.h>

#include <algorithm>

namespace frustumscreen::settings {
namespace {

TEST(WindowSettings, NoWindowsExistUnlessACountIsGiven) {
    EXPECT_FALSE(parsed("").windows.exist());
    EXPECT_FALSE(parsed("[windows]\nwidth_m = 0.1\n").windows.exist());
    EXPECT_FALSE(parsed(shipped_text()).windows.exist());
    EXPECT_TRUE(parsed("[windows]\ncount = 1\n").windows.exist());
}

TEST(WindowSettings, ParsesEveryKey) {
    const WindowSettings read = parsed("[windows]\ncount = 6\nwidth_m = 0.1\ndepth_m = 0.07\n").windows;
    EXPECT_EQ(read.count, 6U);
    EXPECT_EQ(read.width_m, 0.1);
    EXPECT_EQ(read.depth_m, 0.07);
}

TEST(WindowSettings, InvalidValuesAreRefusedInOneLine) {
    const std::vector<std::pair<std::string, std::vector<std::string>>> refused = {
        {"[windows]\ncount = 7\n", {":2: windows.count is 7", "0 to 6"}},
        {"[windows]\ncount = -1\n", {":2: windows.count is -1", "0 to 6"}},
        {"[windows]\ncount = 1.5\n", {":2: windows.count"}},
        {"[windows]\nwidth_m = 0.01\n", {":2: windows.width_m is 0.01", "0.04 to 0.4 metres"}},
        {"[windows]\nsize_m = 0.1\n", {":2: windows.size_m is not"}},
        {"[windows]\ncount = 1\nwidth_m = 0.4\ndepth_m = 0.4\n[table]\nwidth_m = 0.5\ndepth_m = 0.45\n",
         {":3: windows.width_m is 0.4", "beside the prop", "[settings.window_size]"}},
        {"[windows]\ncount = 1\nwidth_m = 0.1\ndepth_m = 0.4\n[table]\nwidth_m = 0.38\ndepth_m = 0.42\n",
         {":4: windows.depth_m is 0.4", "beside the prop", "[settings.window_size]"}},
    };
    for (const auto& [text, words] : refused) {
        const std::string message = refusal(text);
        EXPECT_EQ(message.find('\n'), std::string::npos) << message;
        for (const std::string& word : words) {
            EXPECT_NE(message.find(word), std::string::npos) << "'" << word << "' not in: " << message;
        }
    }
}

/// With a count of 0 no window need fit; a window that just fits beside the prop is allowed.
TEST(WindowSettings, MustFitBesideThePropIfAnyExist) {
    const std::string table = "[table]\nwidth_m = 0.4\ndepth_m = 0.3\n";
    EXPECT_EQ(refusal("[windows]\nwidth_m = 0.4\n" + table), "");
    const Settings usual = parsed(table);
    const Rectangle lit = rectangle_inside(picture_on_table(usual, 0.0));
    const double beside_m = 2.0 * lit.half_m.x - usual.prop.base_m;
    const auto with = [&](double width_m) {
        return fmt::format("[windows]\ncount = 1\nwidth_m = {}\ndepth_m = 0.2\n", width_m) + table;
    };
    ASSERT_GT(beside_m, 0.05);
    EXPECT_EQ(refusal(with(beside_m - 0.001)), "");
    EXPECT_NE(refusal(with(beside_m + 0.001)), "");
}

TEST(WindowSettings, AppearInTheJsonReport) {
    const auto settings = parse_settings("[windows]\ncount = 3\nwidth_m = 0.1\n", "set/kiosk.toml");
    ASSERT_TRUE(settings);
    const auto json = nlohmann::json::parse(config_json(*settings));
    EXPECT_EQ(json["windows"]["count"], 3);
    EXPECT_EQ(json["windows"]["width_m"], 0.1);
    EXPECT_EQ(json["windows"]["depth_m"], 0.12);
}

TEST(WindowSettings, ExampleIsAcceptedAndHasTheWindowButton) {
    const auto settings = load_settings(source_dir() + "/config/windows.toml");
    ASSERT_TRUE(settings) << settings.error().message;
    EXPECT_EQ((*settings)->windows.count, 4U);
    const auto& script = (*settings)->panel.script;
    EXPECT_TRUE(std::any_of(script.begin(), script.end(), [](const ScriptedPress& press) {
        return command_of_button(press.button) == Command::Window;
    }));
}

} // namespace
} // namespace frustumscreen::settings
