// The tables [[torch]] of artifact.toml, and the messages about mistakes in them.
#include "assets_baked/folder/artifact_file.h"
#include "tests/base/told.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <numbers>
#include <string>
#include <utility>
#include <vector>

namespace frustumscreen::folder {
namespace {

using torch::Source;

constexpr std::string_view head = "scan = \"vase.glb\"\n";

Result<ArtifactFile> parse(const std::string& lines) {
    return parse_artifact_file(std::string(head) + lines, "vase/artifact.toml");
}

std::string refusal_of(const std::string& lines) {
    const Result<ArtifactFile> file = parse("[[torch]]\n" + lines);
    return file ? std::string() : test::told(file.error());
}

TEST(ArtifactTorches, parse_every_key) {
    const Result<ArtifactFile> file = parse(R"(
[[torch]]
name = "x-ray"
layer = "xray.png"
lit = false
titles = { en = "X-ray", DE = "Röntgenbild" }
[[torch]]
name = "growth"
film = "frames/growth-*.png"
rate_hz = 12.5
shape = "round"
height_per_width = 0.5
[[torch]]
name = "look"
blend = "light"
[[torch.stage]]
effect = "lens"
size = 0.8
magnification = 3
[[torch.stage]]
effect = "ring"
mix = "add"
colour = [1, 0.5, 0]
opacity = 0.75
size = 0.9
width = 0.01
scroll_per_s = [0.1, -0.2]
turn_deg_per_s = 90
pulse_hz = 1
pulse_depth = 0.5
)");
    ASSERT_TRUE(file) << file.error().message;
    ASSERT_EQ(file->torches.size(), 3U);
    const ArtifactTorch& xray = file->torches[0];
    EXPECT_EQ(xray.name, "x-ray");
    EXPECT_EQ(xray.blend, torch::Blend::Over) << "as a layer's";
    ASSERT_EQ(xray.stages.size(), 1U);
    EXPECT_EQ(xray.stages[0].look.source, Source::Layer);
    EXPECT_EQ(xray.stages[0].file, "vase/xray.png");
    EXPECT_FALSE(xray.stages[0].lit);
    EXPECT_EQ(xray.titles, (std::vector<pack::PackLabel>{{"de", "Röntgenbild"}, {"en", "X-ray"}}));
    const ArtifactTorch& growth = file->torches[1];
    EXPECT_EQ(growth.blend, torch::Blend::Light);
    EXPECT_EQ(growth.stages[0].rate_hz, 12.5);
    EXPECT_EQ(growth.shape, torch::Shape::Round);
    EXPECT_EQ(growth.height_per_width, 0.5);
    const ArtifactTorch& look = file->torches[2];
    EXPECT_EQ(look.blend, torch::Blend::Light) << "written, though it has a lens";
    ASSERT_EQ(look.stages.size(), 2U);
    EXPECT_EQ(look.stages[0].look.magnification, 3.0);
    const torch::Stage& ring = look.stages[1].look;
    EXPECT_EQ(ring.source, Source::Ring);
    EXPECT_EQ(ring.mix, torch::Mix::Add);
    EXPECT_EQ(ring.colour, glm::vec3(1.0F, 0.5F, 0.0F));
    EXPECT_EQ(ring.opacity, 0.75);
    EXPECT_EQ(ring.scroll_per_s, glm::dvec2(0.1, -0.2));
    EXPECT_NEAR(ring.turn_rad_per_s, std::numbers::pi / 2.0, 1e-12);
    EXPECT_EQ(std::pair(ring.pulse_hz, ring.pulse_depth), std::pair(1.0, 0.5));
}

TEST(ArtifactTorches, report_mistakes) {
    ASSERT_EQ(refusal_of("name = \"a\"\neffect = \"grid\"\n"), "");
    for (const auto& [lines, words] : std::vector<std::pair<std::string, std::vector<std::string>>>{
             {"effect = \"grid\"\n", {"[torch_file.no_name]"}},
             {"name = \"white\"\neffect = \"grid\"\n", {"[torch_file.no_name]"}},
             {"name = \"a\"\n", {"[torch_file.source]", "is missing"}},
             {"name = \"a\"\neffect = \"grid\"\npicture = \"b.png\"\n", {"[torch_file.source]", "not alone"}},
             {"name = \"a\"\neffect = \"laser\"\n", {"laser", "ruler"}},
             {"name = \"a\"\npicture = \"../b.png\"\n", {"[folder.file_name]"}},
             {"name = \"a\"\npicture = \"\"\n", {"[torch_file.no_file]"}},
             {"name = \"a\"\neffect = \"grid\"\nrate_hz = 5\n",
              {"[torch_file.unused_key]", "rate_hz", "grid"}},
             {"name = \"a\"\neffect = \"ruler\"\nmagnification = 2\n", {"magnification", "ruler"}},
             {"name = \"a\"\neffect = \"ring\"\npulse_hz = 9\n", {"pulse_hz", "2.5", "seizure"}},
             {"name = \"a\"\neffect = \"ring\"\nscroll_per_s = [1]\n", {"scroll_per_s", "2 numbers"}},
             {"name = \"a\"\neffect = \"ring\"\nsise = 1\n", {"sise", "size"}},
             {"name = \"a\"\neffect = \"ring\"\nsize = 0\n", {"size", "0.001"}},
             {"name = \"a\"\neffect = \"ring\"\n[[torch]]\nname = \"a\"\neffect = \"grid\"\n",
              {"[torch_file.name_twice]"}},
             {"name = \"a\"\neffect = \"ring\"\n[[torch.stage]]\neffect = \"grid\"\n",
              {"[torch_file.both_forms]"}},
             {"name = \"a\"\n[[torch.stage]]\nlayer = \"b.png\"\n[[torch.stage]]\nlayer = \"c.png\"\n",
              {"[torch_file.stages]", "more than one layer"}},
             {"name = \"a\"\n[[torch.stage]]\npicture = \"b.png\"\n[[torch.stage]]\nfilm = \"c\"\n",
              {"[torch_file.stages]"}},
         }) {
        const std::string told = refusal_of(lines);
        for (const std::string& word : words) {
            EXPECT_NE(told.find(word), std::string::npos) << lines << word << ": " << told;
        }
    }
    std::string many;
    for (int k = 0; k < 17; ++k) {
        many += fmt::format("[[torch]]\nname = \"{}\"\neffect = \"grid\"\n", k);
    }
    const Result<ArtifactFile> too_many = parse(many);
    ASSERT_FALSE(too_many);
    EXPECT_NE(too_many.error().message.find("16"), std::string::npos) << too_many.error().message;
    const Result<ArtifactFile> single = parse("[torch]\nname = \"a\"\n");
    ASSERT_FALSE(single);
    EXPECT_NE(single.error().message.find("[[torch]]"), std::string::npos) << single.error().message;
}

} // namespace
} // namespace frustumscreen::folder
