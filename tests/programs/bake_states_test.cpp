// [[states]] of a curator's folder, from the files to the pack, and the sentences about what cannot be a state.
#include "app/image/image.h"
#include "app/pack/pack_file.h"
#include "app/pack/pack_states.h"
#include "app/pack/pack_torches.h"
#include "app/pack/pack_world.h"
#include "firmware_host/base/json.h"
#include "tests/programs/curators_folder.h"

#include <glm/glm.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace frustumscreen::programs {
namespace {

namespace fs = std::filesystem;

/// Two nodes, a body and a lid on it, of three triangles each in one buffer, with one picture.
constexpr const char* pot = R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}],
"nodes": [{"name": "body", "mesh": 0, "children": [1]}, {"name": "lid", "mesh": 0, "translation": [0, 1.2, 0], "children": [2]},
{"name": "knob", "mesh": 0, "translation": [0, 1.2, 0], "scale": [0.2, 0.2, 0.2]}],
"meshes": [{"primitives": [{"attributes": {"POSITION": 0, "TEXCOORD_0": 1}, "indices": 2, "material": 0}]}],
"materials": [{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}],
"textures": [{"source": 0}], "images": [{"uri": "clay.png"}],
"buffers": [{"byteLength": 104, "uri": "pot.bin"}],
"bufferViews": [{"buffer": 0, "byteOffset": 0, "byteLength": 48}, {"buffer": 0, "byteOffset": 48, "byteLength": 32},
{"buffer": 0, "byteOffset": 80, "byteLength": 24}],
"accessors": [{"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 1]},
{"bufferView": 1, "componentType": 5126, "count": 4, "type": "VEC2"},
{"bufferView": 2, "componentType": 5123, "count": 12, "type": "SCALAR"}]})";

class BakeStates : public CuratorsFolder {
protected:
    void SetUp() override {
        fs::create_directories(folder / "pot");
        put("pot/pot.gltf", pot);
        std::string bytes;
        const auto add = [&](const auto& values) {
            bytes.append(reinterpret_cast<const char*>(values.data()), sizeof(values));
        };
        add(std::array<float, 12>{0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1});
        add(std::array<float, 8>{0, 0, 1, 0, 0, 1, 1, 1});
        add(std::array<std::uint16_t, 12>{0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3});
        put("pot/pot.bin", bytes);
        put_picture("pot/clay.png", {32, 32}, {200, 100, 50, 255});
        put_picture("pot/found.png", {32, 32}, {20, 220, 60, 255});
        put_picture("pot/dirt.png", {32, 32}, {0, 0, 255, 128});
    }
    void put_file(const std::string& lines) const {
        put("pot/artifact.toml",
            "scan = \"pot.gltf\"\nsize = 16\nunlit = true\n[[texts]]\nlanguage = \"en\"\ntitle = \"Pot\"\n"
            "[[behaviours]]\nname = \"open\"\ncell = \"lid\"\nspring = { axis = [0, 1, 0], reach_deg = 90 "
            "}\n" +
                lines);
    }
    [[nodiscard]] std::string refusal(const std::string& lines) const {
        put_file("[[states]]\n" + lines);
        return refusal_of("pot");
    }
};

constexpr const char* three_states = R"(
[[states]]
name = "found"
layer = "found.png"
titles = { en = "As found" }
[[states]]
name = "broken"
hide = ["lid"]
layer = "dirt.png"
titles = { en = "Without its lid" }
[[states]]
name = "opened"
behaviour = "open"
titles = { en = "Opened" }
)";

TEST_F(BakeStates, pack_contains_states_with_cells_behaviours_and_layers) {
    put_file(three_states);
    ASSERT_EQ(run("frustumscreen-bake pot -o pot.fspack --speech none"), 0) << text("err.txt");
    EXPECT_NE(text("out.txt").find("state   broken: without lid, in dirt.png"), std::string::npos)
        << text("out.txt");
    EXPECT_EQ(text("out.txt").find("not used"), std::string::npos) << text("out.txt");
    const pack::VerifiedPack pack = pack::load_pack(folder / "pot.fspack").value();
    const std::vector<pack::PackState> states = pack::states_of(*pack).value();
    const pack::PackWorld world = pack::world_outline_of(*pack).value();
    const pack::PackTorches torches = pack::torches_of(*pack).value();
    ASSERT_EQ(states.size(), 3U);
    EXPECT_EQ(states[0].layer, 0U);
    EXPECT_EQ(states[1].layer, 1U);
    ASSERT_EQ(states[1].hidden.size(), 2U) << "the lid, and the knob on it";
    EXPECT_EQ(world.cells[states[1].hidden[0]].cell.name, "lid");
    EXPECT_EQ(world.cells[states[1].hidden[1]].cell.name, "knob");
    EXPECT_EQ(states[2].behaviour, 0U);
    EXPECT_TRUE(torches.contents.empty());
    ASSERT_EQ(torches.layers.size(), 2U);

    // Half of the dirt's blue over the clay, in linear light; and no texel lets anything through.
    const auto share_of = [&](std::size_t layer, const glm::dvec3& colour) {
        const image::Image8 texture =
            pack::load_layer_texture(folder / "pot.fspack", torches.layers[layer], 0).value();
        double near = 0.0;
        for (const glm::u8vec4& texel : texture.texels) {
            EXPECT_EQ(texel.a, 255);
            near += glm::distance(glm::dvec3(texel), colour) <= 4.0 ? 1.0 : 0.0;
        }
        return near / static_cast<double>(texture.texels.size());
    };
    const auto mixed = [](double own, double over) {
        const auto linear = [](double code) {
            const double c = code / 255.0;
            return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
        };
        const double share = 128.0 / 255.0, light = (1.0 - share) * linear(own) + share * linear(over);
        return 255.0 * (light <= 0.0031308 ? 12.92 * light : 1.055 * std::pow(light, 1.0 / 2.4) - 0.055);
    };
    const glm::dvec3 expected(mixed(200.0, 0.0), mixed(100.0, 0.0), mixed(50.0, 255.0));
    const double charts = share_of(0, {20.0, 220.0, 60.0}); // the rest of the texture is between them
    EXPECT_GT(charts, 0.02);
    EXPECT_NEAR(share_of(1, expected), charts, 0.05 * charts);
    EXPECT_EQ(share_of(1, {0.0, 0.0, 255.0}), 0.0);

    ASSERT_EQ(run("frustumscreen-pack verify pot.fspack"), 0) << text("err.txt");
    ASSERT_EQ(run("frustumscreen-pack explain pot.fspack --json"), 0) << text("err.txt");
    const nlohmann::json told = nlohmann::json::parse(text("out.txt")).at("states");
    ASSERT_EQ(told.size(), 3U);
    EXPECT_EQ(told[1].at("name"), "broken");
    EXPECT_EQ(told[1].at("hidden"), (std::vector<std::string>{"lid", "knob"}));
    EXPECT_EQ(told[2].at("behaviour"), "open");
    EXPECT_TRUE(told[2].at("layer").is_null());
    EXPECT_EQ(told[0].at("titles").at("en"), "As found");
}

TEST_F(BakeStates, check_lists_states) {
    put_file(three_states);
    ASSERT_EQ(run("frustumscreen-bake --check pot"), 0) << text("err.txt");
    EXPECT_NE(text("out.txt").find("opened: at the end of open"), std::string::npos) << text("out.txt");
}

TEST_F(BakeStates, reports_invalid_states_in_one_line) {
    const std::string good = "name = \"a\"\ntitles = { en = \"A\" }\n";
    for (const auto& [lines, word] : std::vector<std::pair<std::string, std::string>>{
             {good + "hide = [\"handle\"]\n", "no part 'handle' to hide; it has body, lid, knob"},
             {good + "behaviour = \"close\"\n", "no behaviour 'close'; it has open"},
             {good + "layer = \"gone.png\"\n", "gone.png"},
             {"name = \"a\"\n", "titles"},
         }) {
        EXPECT_NE(refusal(lines).find(word), std::string::npos) << lines << text("err.txt");
    }
    put_file(three_states);
    EXPECT_EQ(run("frustumscreen-bake pot -o pot.fspack --speech none --cells none"), 1);
    EXPECT_NE(text("err.txt").find("open"), std::string::npos) << text("err.txt");
}

TEST_F(BakeStates, pack_without_states_has_no_states_section) {
    put_file("");
    ASSERT_EQ(run("frustumscreen-bake pot -o pot.fspack --speech none"), 0) << text("err.txt");
    const pack::VerifiedPack pack = pack::load_pack(folder / "pot.fspack").value();
    for (const pack::PackSection& section : pack->sections) {
        EXPECT_NE(section.name, pack::states_section);
    }
}

} // namespace
} // namespace frustumscreen::programs
