// The tables [[behaviours]] of artifact.toml, and the messages about mistakes in them.
#include "assets_baked/folder/artifact_file.h"
#include "tests/base/told.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

namespace frustumscreen::folder {
namespace {

constexpr std::string_view head =
    "scan = \"chest.glb\"\n[[hotspots]]\npoint = [0, 0, 0]\nlabels = { en = \"x\" }\n";

std::string refusal_of(const std::string& lines) {
    const Result<ArtifactFile> file =
        parse_artifact_file(std::string(head) + "[[behaviours]]\n" + lines, "chest/artifact.toml");
    return file ? std::string() : test::told(file.error());
}

TEST(ArtifactBehaviours, parse_every_key) {
    const Result<ArtifactFile> file = parse_artifact_file(std::string(head) + R"(
[[behaviours]]
name = "open"
animation = "Lid"
trigger = "hotspot"
hotspot = 0
stays = true
titles = { en = "Turn the lid", DE = "Den Deckel drehen" }
[[behaviours]]
name = "drawer"
cell = "drawer"
spring = { axis = [0, 3, 4], reach_mm = 80, stiffness = 40, damping = 6 }
[[behaviours]]
name = "bell"
cell = "bell"
pendulum = { axis = [1, 0, 0], reach_deg = 8, length_m = 0.5, damping = 0.1 }
trigger = "narration"
narration_s = 12.5
[[behaviours]]
name = "lamp"
cell = "lamp"
light = [4, 2, 1]
seconds = 3
repeats = true
trigger = "dwell"
)",
                                                          "chest/artifact.toml");
    ASSERT_TRUE(file) << file.error().message;
    ASSERT_EQ(file->behaviours.size(), 4U);
    const ArtifactBehaviour& open = file->behaviours[0];
    EXPECT_EQ(open.animation, "Lid");
    EXPECT_EQ(open.trigger, world::Trigger::Hotspot);
    EXPECT_TRUE(open.stays && !open.repeats);
    EXPECT_EQ(open.titles,
              (std::vector<pack::PackLabel>{{"de", "Den Deckel drehen"}, {"en", "Turn the lid"}}));
    EXPECT_EQ(open.place, "chest/artifact.toml:7: behaviours[0].name");
    const ArtifactBehaviour& drawer = file->behaviours[1];
    ASSERT_TRUE(drawer.spring);
    EXPECT_LT(glm::length(drawer.spring->axis - glm::dvec3(0, 0.6, 0.8)), 1e-15);
    EXPECT_EQ(drawer.spring->reach_mm, 80.0);
    EXPECT_FALSE(drawer.spring->reach_deg);
    EXPECT_EQ(drawer.spring->stiffness_per_s2, 40.0);
    EXPECT_EQ(drawer.trigger, world::Trigger::Button);
    ASSERT_TRUE(file->behaviours[2].pendulum);
    EXPECT_EQ(file->behaviours[2].pendulum->length_m, 0.5);
    EXPECT_EQ(file->behaviours[2].narration_s, 12.5);
    ASSERT_TRUE(file->behaviours[3].light);
    EXPECT_EQ(file->behaviours[3].light->colour, glm::dvec3(4, 2, 1));
    EXPECT_EQ(file->behaviours[3].light->seconds, 3.0);
}

TEST(ArtifactBehaviours, report_mistakes_with_line_and_remedy) {
    const std::string spring = "spring = { axis = [0, 0, 1], reach_deg = 5 }\n";
    const std::vector<std::pair<std::string, std::string>> wrong{
        {"animation = \"a\"", ":5: behaviours[0].name is missing or empty"},
        {"name = \"a\"\nanimaton = \"a\"",
         ":7: behaviours[0].animaton is not a known key; the nearest allowed key is behaviours[0].animation"},
        {"name = \"a\"", "behaviours[0].animation is missing; write animation, spring, pendulum or light"},
        {"name = \"a\"\nanimation = \"a\"\nlight = [1, 1, 1]", ":7: behaviours[0].animation is not alone"},
        {"name = \"a\"\n" + spring, "behaviours[0].cell is missing; name the part"},
        {"name = \"a\"\nanimation = \"a\"\ncell = \"lid\"", ":8: behaviours[0].cell stands beside animation"},
        {"name = \"a\"\nanimation = \"a\"\nseconds = 3", ":8: behaviours[0].seconds stands without light"},
        {"name = \"a\"\ncell = \"lid\"\nspring = { axis = [0, 0, 1] }",
         "behaviours[0].spring.reach_deg is missing, and so is reach_mm"},
        {"name = \"a\"\ncell = \"lid\"\nspring = { reach_mm = 1, reach_deg = 1 }", "stands beside reach_mm"},
        {"name = \"a\"\ncell = \"lid\"\nspring = { axis = [0, 0, 0], reach_deg = 1 }",
         ":8: behaviours[0].spring.axis has no length"},
        {"name = \"a\"\ncell = \"lid\"\nspring = { stiffness = 0, reach_deg = 1 }",
         ":8: behaviours[0].spring.stiffness is 0"},
        {"name = \"a\"\ncell = \"lid\"\nspring = { dampnig = 0, reach_deg = 1 }",
         ":8: behaviours[0].spring.dampnig is not a known key; the nearest allowed key is "
         "behaviours[0].spring.damping"},
        {"name = \"a\"\ncell = \"lid\"\nlight = [1, -1, 1]", ":8: behaviours[0].light[1] is -1"},
        {"name = \"a\"\ncell = \"lid\"\npendulum = 3", ":8: behaviours[0].pendulum is 3"},
        {"name = \"a\"\nanimation = \"a\"\ntrigger = \"push\"",
         ":8: behaviours[0].trigger is the text \"push\"; allowed are \"button\""},
        {"name = \"a\"\nanimation = \"a\"\ntrigger = \"hotspot\"",
         "behaviours[0].hotspot is missing; trigger = \"hotspot\" needs it"},
        {"name = \"a\"\nanimation = \"a\"\ntrigger = \"hotspot\"\nhotspot = 1",
         ":9: behaviours[0].hotspot is 1; the file has 1 tables [[hotspots]], counted from 0"},
        {"name = \"a\"\nanimation = \"a\"\nnarration_s = 1",
         ":8: behaviours[0].narration_s stands without trigger = \"narration\""},
        {"name = \"a\"\nanimation = \"a\"\ntitles = { en = \"x\", EN = \"y\" }",
         ":8: behaviours[0].titles has \"en\" twice"},
        {"name = \"a\"\nanimation = \"a\"\ntitles = { english = \"x\" }",
         ":8: behaviours[0].titles is for \"english\""},
        {"name = \"a\"\nanimation = \"a\"\n[[behaviours]]\nname = \"a\"\nanimation = \"b\"",
         ":9: behaviours[1].name is \"a\" a second time"}};
    for (const auto& [text, words] : wrong) {
        const std::string message = refusal_of(text);
        EXPECT_EQ(message.find("chest/artifact.toml:"), 0U) << message;
        EXPECT_NE(message.find(words), std::string::npos) << words << "\n" << message;
        EXPECT_EQ(message.find('\n'), std::string::npos) << message;
    }
    const auto refusal = [](const std::string& text) {
        const Result<ArtifactFile> file = parse_artifact_file("scan = \"a.glb\"\n" + text, "artifact.toml");
        return file ? std::string() : file.error().message;
    };
    EXPECT_NE(refusal("[behaviours]\nname = \"a\"").find("[behaviours] has one bracket too few"),
              std::string::npos);
    EXPECT_NE(refusal("[[behaviors]]\nname = \"a\"").find("the nearest one is [[behaviours]]"),
              std::string::npos);
    EXPECT_NE(refusal("trigger = \"dwell\"").find("trigger belongs below a line [[behaviours]]"),
              std::string::npos);
    std::string many;
    for (std::size_t k = 0; k <= world::max_behaviours; ++k) {
        many += fmt::format("[[behaviours]]\nname = \"{}\"\nanimation = \"a\"\n", k);
    }
    EXPECT_NE(refusal(many).find("at most 32 tables"), std::string::npos);
}

} // namespace
} // namespace frustumscreen::folder
