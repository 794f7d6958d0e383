#include "app/settings/config_json.h"
#include "tests/settings/settings_text.h"

#include <nlohmann/json.hpp>

namespace frustumscreen {
namespace {

nlohmann::json report_of(const std::string& text) {
    const auto settings = parse_settings(text, "set/kiosk.toml");
    EXPECT_TRUE(settings) << settings.error().message;
    return settings ? nlohmann::json::parse(config_json(*settings)) : nlohmann::json();
}

TEST(ConfigJson, HoldsTheFieldsThatOutsideChecksRelyOn) {
    const nlohmann::json json = report_of(shipped_text());
    const nlohmann::json& projector = json.at("projector");
    EXPECT_EQ(projector.at("width"), 1280);
    EXPECT_EQ(projector.at("height"), 800);
    EXPECT_EQ(projector.at("fx"), 1920.0);
    EXPECT_EQ(projector.at("fy"), 1920.0);
    EXPECT_EQ(projector.at("cx"), 640.0);
    EXPECT_EQ(projector.at("cy"), 400.0);
    const nlohmann::json expected{1, 0, 0, 0, 0, -1, 0, 0, 0, 0, -1, 0, 0, 0, 1.2, 1};
    ASSERT_EQ(projector.at("table_from_projector").size(), 16U);
    for (std::size_t k = 0; k < 16; ++k) {
        EXPECT_NEAR(projector["table_from_projector"][k].get<double>(), expected[k].get<double>(), 1e-15);
    }
    EXPECT_EQ(json.at("render").at("error_tolerance_px"), 0.5);
    EXPECT_EQ(json.at("prop"),
              nlohmann::json({{"kind", "frustum"}, {"base_m", 0.16}, {"top_m", 0.09}, {"height_m", 0.12}}));
    EXPECT_EQ(json.at("eye_default_m"), nlohmann::json({0.0, -0.55, 0.50}));
    EXPECT_EQ(json.at("eye_zone").at("lowest_elevation_deg"), 15.0);
    EXPECT_GT(json.at("lit_zone").at("any_eye").at("area_m2"), 0.1);
    EXPECT_GT(json.at("lit_zone").at("any_eye").at("polygon_m").size(), 4U);
    EXPECT_GT(json.at("lit_zone").at("default_eye").at("polygon_m").size(), 300U);
}

TEST(ConfigJson, PathsThatAreNotUtf8DoNotStopTheReport) {
    const auto settings = parse_settings("[exhibit]\npacks = [\"a\"]\n", "s\xFFt/kiosk.toml");
    ASSERT_TRUE(settings);
    EXPECT_EQ(nlohmann::json::parse(config_json(*settings)).at("exhibit").at("packs").size(), 1U);
}

} // namespace
} // namespace frustumscreen
