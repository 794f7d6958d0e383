// [[torch]] of a curator's folder, from its files to the pack, and the sentences about what a pack cannot hold.
#include "app/image/image.h"
#include "app/pack/pack_file.h"
#include "app/pack/pack_torches.h"
#include "tests/programs/curators_folder.h"

#include <glm/glm.hpp>

#include <algorithm>

namespace frustumscreen::programs {
namespace {

namespace fs = std::filesystem;

constexpr const char* jug =
    "mtllib jug.mtl\nv 0 0 0\nv 1 0 0\nv 0 0 1\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nvt 1 1\nusemtl "
    "clay\nf 1/1 3/3 2/2\nf 1/1 2/2 4/4\nf 1/1 4/4 3/3\nf 2/2 3/3 4/4\n";

class BakeTorches : public CuratorsFolder {
protected:
    void SetUp() override {
        fs::create_directories(folder / "jug/frames");
        put("jug/jug.obj", jug);
        put("jug/jug.mtl", "newmtl clay\nmap_Kd clay.png\n");
        put_picture("jug/clay.png", {32, 32}, {200, 100, 50, 255});
        put_picture("jug/first.png", {64, 64}, {20, 220, 60, 255});
        put_picture("jug/marks.png", {40, 20}, {255, 255, 255, 128});
        put_picture("jug/frames/f1.png", {16, 16}, {255, 0, 0, 255});
        put_picture("jug/frames/f2.png", {16, 16}, {0, 0, 255, 255});
    }
    void put_torch(const std::string& lines) const {
        put("jug/artifact.toml", "scan = \"jug.obj\"\nsize = 16\nunlit = true\n[[texts]]\nlanguage = "
                                 "\"en\"\ntitle = \"Jug\"\n" +
                                     lines);
    }
    /// The check's sentence on a [[torch]] that cannot be baked.
    [[nodiscard]] std::string refusal(const std::string& lines) const {
        put_torch("[[torch]]\nname = \"a\"\n" + lines + "\n");
        return refusal_of("jug");
    }
};

constexpr const char* three = R"(
[[torch]]
name = "first colours"
layer = "first.png"
titles = { en = "As it was" }
[[torch]]
name = "marks"
picture = "marks.png"
[[torch]]
name = "growth"
film = "frames"
rate_hz = 5
)";

TEST_F(BakeTorches, pack_contains_torch_contents) {
    put_torch(three);
    ASSERT_EQ(run("frustumscreen-bake jug -o jug.fspack --speech none"), 0) << text("err.txt");
    EXPECT_NE(text("out.txt").find("torch   'marks': picture marks.png, 40 x 20 pixels, 1 kB; light"),
              std::string::npos)
        << text("out.txt");
    EXPECT_EQ(text("out.txt").find("not used"), std::string::npos) << text("out.txt");
    const pack::VerifiedPack pack = pack::load_pack(folder / "jug.fspack").value();
    ASSERT_TRUE(pack::check_torches(*pack));
    const pack::PackTorches torches = pack::torches_of(*pack).value();
    ASSERT_EQ(torches.contents.size(), 3U);
    EXPECT_EQ(torches.contents[0].content.blend, torch::Blend::Over);
    EXPECT_EQ(torches.contents[1].content.height_per_width, 0.5);
    EXPECT_EQ(torches.contents[1].content.shape, torch::Shape::Rectangle);
    EXPECT_EQ(torches.films[0].frames, 2U);
    EXPECT_EQ(torches.films[0].rate_hz, 5.0);
    const image::Image8 layer = pack::layer_texture_of(*pack, torches.layers[0], 0).value();
    const auto is_first = [](const glm::u8vec4& texel) {
        return glm::distance(glm::dvec4(texel), glm::dvec4(20, 220, 60, 255)) < 3.0;
    };
    EXPECT_GT(std::count_if(layer.texels.begin(), layer.texels.end(), is_first),
              static_cast<std::ptrdiff_t>(layer.texels.size() / 20));
    EXPECT_EQ(run("frustumscreen-pack verify jug.fspack"), 0) << text("err.txt");
    ASSERT_EQ(run("frustumscreen-pack explain jug.fspack"), 0) << text("err.txt");
    EXPECT_NE(text("out.txt").find("torch first colours: layer first.png ("), std::string::npos)
        << text("out.txt");
    ASSERT_EQ(run("frustumscreen-pack explain jug.fspack --json"), 0) << text("err.txt");
    EXPECT_NE(text("out.txt").find("\"rate_hz\": 5.0"), std::string::npos) << text("out.txt");
}

TEST_F(BakeTorches, check_lists_torch_contents) {
    put_torch(three);
    ASSERT_EQ(run("frustumscreen-bake --check jug"), 0) << text("err.txt");
    EXPECT_NE(
        text("out.txt").find("'growth': film frames, 2 frames of 16 x 16 pixels, 5 a second, 1 kB; light"),
        std::string::npos)
        << text("out.txt");
}

TEST_F(BakeTorches, accepts_a_model_of_the_same_surface_as_a_layer) {
    put("jug/first.obj", "mtllib first.mtl\n" + std::string(jug).substr(std::string(jug).find("v 0")));
    put("jug/first.mtl", "newmtl clay\nmap_Kd first.png\n");
    put_torch("[[torch]]\nname = \"a\"\nlayer = \"first.obj\"\n");
    ASSERT_EQ(run("frustumscreen-bake --check jug"), 0) << text("err.txt");
    std::string moved = text("jug/first.obj");
    moved.replace(moved.find("v 1 0 0"), 7, "v 2 0 0");
    put("jug/first.obj", moved);
    EXPECT_NE(refusal("layer = \"first.obj\"").find("[torch_layers.other_surface]"), std::string::npos);
    std::string other_uv = text("jug/first.obj");
    other_uv.replace(other_uv.find("v 2 0 0"), 7, "v 1 0 0");
    other_uv.replace(other_uv.find("vt 1 1"), 6, "vt 1 0.5");
    put("jug/first.obj", other_uv);
    EXPECT_NE(refusal("layer = \"first.obj\"").find("other texture coordinates"), std::string::npos)
        << text("err.txt");
}

TEST_F(BakeTorches, reports_contents_that_a_pack_cannot_hold) {
    put_picture("jug/wide.png", {64, 32}, {0, 0, 0, 255});
    put_picture("jug/dot.png", {1, 1}, {0, 0, 0, 255});
    put_picture("jug/huge.png", {16384, 128}, {0, 0, 0, 255});
    fs::create_directories(folder / "jug/many");
    for (int k = 0; k < 601; ++k) {
        put("jug/many/" + std::to_string(k) + ".png", "x");
    }
    put("jug/broken.webp", "RIFF....WEBPVP8X");
    for (const auto& [lines, words] : std::vector<std::pair<std::string, std::string>>{
             {"picture = \"nothing.png\"", "nothing.png"},
             {"picture = \"dot.png\"", "1 x 1 pixels; allowed are 8 to 2048"},
             {"picture = \"huge.png\"", "16384 x 128"},
             {"picture = \"broken.webp\"", "damaged"},
             {"film = \"many\"", "601 frames; allowed are 2 to 600"},
             {"film = \"broken.webp\"", "broken.webp"},
             {"film = \"marks.png\"", "not an animated WebP"},
             {"layer = \"wide.png\"", "64 x 32 pixels, the scan's picture 32 x 32"},
             {"layer = \"dot.png\"", "1 x 1"},
             {"layer = \"jug.mtl\"", "neither PNG"},
         }) {
        EXPECT_NE(refusal(lines).find(words), std::string::npos) << lines << ": " << text("err.txt");
    }
}

} // namespace
} // namespace frustumscreen::programs
