// The table [torch]: every key, what its sources need, and a beam that makes sense.
#include "app/settings/config_json.h"
#include "firmware_host/base/json.h"
#include "tests/settings/settings_text.h"

#include <numbers>

namespace frustumscreen::settings {
namespace {

/// A camera that can see tags, with one on the prop.
const std::string camera_with_tags =
    "[camera]\nkind = \"v4l2\"\ntags = true\nfx = 1500\n"
    "table_from_camera = [1, 0, 0, 0,  0, -1, 0, 0,  0, 0, -1, 0,  0, 0, 1.3, 1]\n"
    "[[camera.tag]]\nid = 4\n";

TEST(TorchSettings, NoTorchExistsUnlessASourceIsNamed) {
    EXPECT_FALSE(parsed("").torch.exists());
    EXPECT_FALSE(parsed("[torch]\nopening_deg = 20\n").torch.exists());
    EXPECT_FALSE(parsed(shipped_text()).torch.exists());
    EXPECT_TRUE(parsed("[torch]\nsource = \"tracker\"\n").torch.exists());
}

TEST(TorchSettings, ParsesEveryKey) {
    const TorchSettings read =
        parsed("[torch]\nsource = \"both\"\nopening_deg = 20\nmin_opening_deg = 5\nmax_opening_deg = 90\n"
               "shape = \"rectangle\"\nattenuation = \"smooth_step\"\nfull_m = 0.2\ndark_m = 0.9\n"
               "house_light = 0.25\n"
               "sensor_from_torch = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0.01, 0.02, 0.1, 1]\n"
               "[torch.tag]\nid = 9\nsize_m = 0.05\ncentre_m = [0, -0.03, 0.01]\nturn_deg = 10\nlean_deg = "
               "80\n" +
               camera_with_tags)
            .torch;
    EXPECT_EQ(read.source, TorchSource::Both);
    EXPECT_TRUE(read.by_tracker() && read.by_camera());
    EXPECT_DOUBLE_EQ(read.beam.opening_rad, std::numbers::pi / 9.0);
    EXPECT_EQ(read.min_opening_deg, 5.0);
    EXPECT_EQ(read.max_opening_deg, 90.0);
    EXPECT_EQ(read.beam.shape, torch::Shape::Rectangle);
    EXPECT_EQ(read.beam.attenuation, torch::Attenuation::SmoothStep);
    EXPECT_EQ(read.beam.full_m, 0.2);
    EXPECT_EQ(read.beam.dark_m, 0.9);
    EXPECT_EQ(read.house_light, 0.25);
    EXPECT_EQ(read.sensor_from_torch.translation, glm::dvec3(0.01, 0.02, 0.1));
    EXPECT_EQ(read.tag.id, 9);
    EXPECT_EQ(read.tag.size_m, 0.05);
    EXPECT_EQ(read.tag.centre_m, glm::dvec3(0, -0.03, 0.01));
    EXPECT_EQ(read.tag.turn_deg, 10.0);
    EXPECT_EQ(read.tag.lean_deg, 80.0);
}

TEST(TorchSettings, HaveTheStructsDefaults) {
    const TorchSettings read = parsed("[torch]\nsource = \"tracker\"\n").torch;
    EXPECT_EQ(read.beam, torch::Beam());
    const TorchSettings usual;
    EXPECT_EQ(read.tag.id, usual.tag.id);
    EXPECT_EQ(read.tag.centre_m, usual.tag.centre_m);
}

/// The lamp's upper side is -Y of the torch; the tag there looks up, and its top looks along the light.
TEST(TorchSettings, PutTheTagOnTheLampsUpperSide) {
    const geometry::RigidTransform torch_from_tag = prop_from_tag(TorchSettings().tag);
    EXPECT_LT(glm::distance(torch_from_tag.direction({0, 0, 1}), glm::dvec3(0, -1, 0)), 1e-12);
    EXPECT_LT(glm::distance(torch_from_tag.direction({0, 1, 0}), glm::dvec3(0, 0, 1)), 1e-12);
}

TEST(TorchSettings, InvalidValuesAreRefusedInOneLine) {
    const std::vector<std::pair<std::string, std::vector<std::string>>> refused = {
        {"[torch]\nsource = \"hand\"\n", {":2: torch.source", "tracker"}},
        {"[torch]\nopening_deg = 180\n", {":2: torch.opening_deg is 180", "0.01 to 179 degrees"}},
        {"[torch]\nsource = \"tracker\"\nopening_deg = 61\n",
         {":3: torch.opening_deg is 61", "from torch.min_opening_deg, 8", "60", "[settings.torch_opening]"}},
        {"[torch]\nattenuation = \"linear\"\nfull_m = 0.5\ndark_m = 0.5\n",
         {":4: torch.dark_m is 0.5", "more than 0.5 metres", "[settings.torch_dark]"}},
        {"[torch]\nhouse_light = 1.5\n", {":2: torch.house_light is 1.5"}},
        {"[torch]\nlight = 1\n", {":2: torch.light is not"}},
        {"[torch.tag]\nid = 587\n", {":2: torch.tag.id is 587"}},
        {"[torch.tag]\nplace = 1\n", {":2: torch.tag.place is not"}},
        {"[torch]\nsource = \"tracker\"\n[tracker]\nkind = \"none\"\n",
         {":2: torch.source", "tracker.kind is \"none\"", "[settings.torch_without_tracker]"}},
        {"[torch]\nsource = \"both\"\n[tracker]\nkind = \"spacemouse\"\n" + camera_with_tags,
         {":2: torch.source is \"both\"", "\"spacemouse\"", "[settings.torch_without_tracker]"}},
        {"[torch]\nsource = \"camera\"\n",
         {":2: torch.source", "camera.tags = true", "[settings.torch_without_tags]"}},
        {"[torch]\nsource = \"camera\"\n[torch.tag]\nid = 4\n" + camera_with_tags,
         {":4: torch.tag.id is 4", "an id of its own", "[settings.torch_tag_twice]"}},
    };
    for (const auto& [text, words] : refused) {
        const std::string message = refusal(text);
        EXPECT_EQ(message.find('\n'), std::string::npos) << message;
        for (const std::string& word : words) {
            EXPECT_NE(message.find(word), std::string::npos) << "'" << word << "' not in: " << message;
        }
    }
}

/// A torch that is not there needs no tracker, and its opening has no range to lie in.
TEST(TorchSettings, UnusedValuesAreNotChecked) {
    EXPECT_EQ(refusal("[torch]\nopening_deg = 90\n[tracker]\nkind = \"none\"\n"), "");
}

TEST(TorchSettings, AppearInTheJsonReport) {
    const auto settings =
        parse_settings("[torch]\nsource = \"tracker\"\nopening_deg = 25\n", "set/kiosk.toml");
    ASSERT_TRUE(settings);
    const auto json = nlohmann::json::parse(config_json(*settings));
    EXPECT_EQ(json["torch"]["source"], "tracker");
    EXPECT_EQ(json["torch"]["opening_deg"], 25.0);
    EXPECT_EQ(json["torch"]["shape"], "round");
    EXPECT_EQ(json["torch"]["attenuation"], "inverse_square");
    EXPECT_EQ(json["torch"]["sensor_from_torch"].size(), 16U);
    EXPECT_EQ(json["torch"]["tag"]["id"], TorchSettings().tag.id);
}

TEST(TorchSettings, ExampleIsAccepted) {
    const auto settings = load_settings(source_dir() + "/config/torch.toml");
    ASSERT_TRUE(settings) << settings.error().message;
    EXPECT_EQ((*settings)->torch.source, TorchSource::Tracker);
}

} // namespace
} // namespace frustumscreen::settings
