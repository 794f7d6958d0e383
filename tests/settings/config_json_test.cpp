#include "app/settings/config_json.h"
#include "firmware_host/base/json.h"
#include "tests/settings/settings_text.h"

#include <cmath>
#include <map>
#include <string>

namespace frustumscreen::settings {
namespace {

nlohmann::json report_of(const std::string& text) {
    const auto settings = parse_settings(text, "set/kiosk.toml");
    EXPECT_TRUE(settings) << settings.error().message;
    return settings ? nlohmann::json::parse(config_json(*settings)) : nlohmann::json();
}

TEST(ConfigJson, ContainsTheFieldsForExternalChecks) {
    const nlohmann::json json = report_of(shipped_text());
    const nlohmann::json& projector = json.at("projector");
    EXPECT_EQ(projector.at("width"), 1920);
    EXPECT_EQ(projector.at("height"), 1200);
    EXPECT_EQ(projector.at("fx"), 3600.0);
    EXPECT_EQ(projector.at("fy"), 3600.0);
    EXPECT_EQ(projector.at("cx"), 960.0);
    EXPECT_EQ(projector.at("cy"), 600.0);
    const nlohmann::json expected{1, 0, 0, 0, 0, -1, 0, 0, 0, 0, -1, 0, 0, 0, 1.5, 1};
    ASSERT_EQ(projector.at("table_from_projector").size(), 16U);
    for (std::size_t k = 0; k < 16; ++k) {
        EXPECT_NEAR(projector["table_from_projector"][k].get<double>(), expected[k].get<double>(), 1e-15);
    }
    EXPECT_EQ(json.at("render").at("error_tolerance_px"), 0.5);
    nlohmann::json prop = json.at("prop");
    prop.erase("faces");
    EXPECT_EQ(prop, nlohmann::json({{"kind", "frustum"},
                                    {"base_m", 0.30},
                                    {"top_m", 0.08},
                                    {"height_m", 0.155},
                                    {"zone", "table"}}));
    EXPECT_EQ(json.at("eye_default_m"), nlohmann::json({0.0, -0.55, 0.50}));
    EXPECT_EQ(json.at("eye_zone").at("lowest_elevation_deg"), 15.0);
    EXPECT_GT(json.at("lit_zone").at("any_eye").at("area_m2"), 0.02);
    EXPECT_GT(json.at("lit_zone").at("any_eye").at("polygon_m").size(), 3U);
    EXPECT_GT(json.at("lit_zone").at("default_eye").at("polygon_m").size(), 300U);
}

/// The faces by name.
std::map<std::string, nlohmann::json> faces_of(const nlohmann::json& json) {
    std::map<std::string, nlohmann::json> faces;
    for (const nlohmann::json& face : json.at("prop").at("faces")) {
        EXPECT_EQ(face.at("corners").size(), 4U);
        faces[face.at("name")] = face;
    }
    return faces;
}

TEST(ConfigJson, ListsTheFacesOfAFrustumAndOfACube) {
    const auto frustum = faces_of(report_of(shipped_text()));
    ASSERT_EQ(frustum.size(), 5U);
    const double length = std::hypot(0.155, 0.11);
    EXPECT_NEAR(frustum.at("-Y").at("normal")[1].get<double>(), -0.155 / length, 1e-12);
    EXPECT_NEAR(frustum.at("-Y").at("normal")[2].get<double>(), 0.11 / length, 1e-12);
    EXPECT_EQ(frustum.at("+Z").at("normal"), nlohmann::json({0.0, 0.0, 1.0}));
    EXPECT_EQ(frustum.at("+Z").at("corners")[0], nlohmann::json({-0.04, -0.04, 0.155}));
    const auto cube = faces_of(report_of("[prop]\nkind = \"cube\"\nbase_m = 0.1\n"));
    ASSERT_EQ(cube.size(), 6U);
    EXPECT_EQ(cube.at("-Z").at("normal"), nlohmann::json({0.0, 0.0, -1.0}));
    for (const nlohmann::json& corner : cube.at("-Z").at("corners")) {
        EXPECT_EQ(corner[2], 0.0);
        EXPECT_EQ(std::abs(corner[0].get<double>()), 0.05);
    }
}

TEST(ConfigJson, ToleratesPathsThatAreNotUtf8) {
    const auto settings = parse_settings("[exhibit]\npacks = [\"a\"]\n", "s\xFFt/kiosk.toml");
    ASSERT_TRUE(settings);
    EXPECT_EQ(nlohmann::json::parse(config_json(*settings)).at("exhibit").at("packs").size(), 1U);
}

} // namespace
} // namespace frustumscreen::settings
