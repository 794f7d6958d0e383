// The preview's pictures of a behaviour and of states: a red lid on a blue box jumps up after half of its time. The pictures
// before are equal, so are those after, and between them red has moved up. A state without the lid shows no red.
#include "app/pack/pack_file.h"
#include "app/programs/preview/behaviour_pictures.h"
#include "app/programs/preview/html_parts.h"
#include "app/programs/preview/state_pictures.h"
#include "tests/folders.h"
#include "tests/programs/curator_folder.h"

#include <array>
#include <cstring>

namespace frustumscreen::programs {
namespace {

constexpr float jump = 0.8F; ///< of the lid, upwards; the box is 0.5 high

template <typename Number, std::size_t Count>
void add(std::string& data, const std::array<Number, Count>& numbers) {
    const std::size_t at = data.size();
    data.resize(at + sizeof numbers);
    std::memcpy(data.data() + at, numbers.data(), sizeof numbers);
}

/// Both boxes have the corners of one; a node scales it. Positions, indices, times and heights of the lid.
std::string box_gltf() {
    std::string data;
    add(data, std::array<float, 24>{-1, 0, -1, 1, 0, -1, -1, 1, -1, 1, 1, -1,
                                    -1, 0, 1,  1, 0, 1,  -1, 1, 1,  1, 1, 1});
    add(data, std::array<std::uint16_t, 36>{0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4,
                                            2, 6, 3, 3, 6, 7, 0, 4, 2, 2, 4, 6, 1, 3, 5, 3, 7, 5});
    add(data, std::array<float, 3>{0.0F, 1.0F, 2.0F});
    add(data, std::array<float, 9>{0, 0.5F, 0, 0, 0.5F + jump, 0, 0, 0.5F + jump, 0});
    return R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0,1]}],"nodes":[)"
           R"({"name":"box","mesh":0,"scale":[1,0.5,1]},)"
           R"({"name":"lid","mesh":1,"translation":[0,0.5,0],"scale":[0.8,0.2,0.8]}],)"
           R"("materials":[{"pbrMetallicRoughness":{"baseColorFactor":[0,0,1,1]}},)"
           R"({"pbrMetallicRoughness":{"baseColorFactor":[1,0,0,1]}}],)"
           R"("meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1,"material":0}]},)"
           R"({"primitives":[{"attributes":{"POSITION":0},"indices":1,"material":1}]}],)"
           R"("animations":[{"name":"jump","samplers":[{"input":2,"output":3,"interpolation":"STEP"}],)"
           R"("channels":[{"sampler":0,"target":{"node":1,"path":"translation"}}]}],"accessors":[)"
           R"({"bufferView":0,"componentType":5126,"count":8,"type":"VEC3","min":[-1,0,-1],"max":[1,1,1]},)"
           R"({"bufferView":1,"componentType":5123,"count":36,"type":"SCALAR"},)"
           R"({"bufferView":2,"componentType":5126,"count":3,"type":"SCALAR","min":[0],"max":[2]},)"
           R"({"bufferView":3,"componentType":5126,"count":3,"type":"VEC3"}],"bufferViews":[)"
           R"({"buffer":0,"byteOffset":0,"byteLength":96},{"buffer":0,"byteOffset":96,"byteLength":72},)"
           R"({"buffer":0,"byteOffset":168,"byteLength":12},{"buffer":0,"byteOffset":180,"byteLength":36}],)" +
           fmt::format(R"("buffers":[{{"byteLength":{},"uri":"data:application/octet-stream;base64,{}"}}]}})",
                       data.size(), base64(as_bytes(data)));
}

struct Red {
    std::size_t texels = 0;
    double row = 0.0; ///< their mean
};
Red red_in(const image::Image8& sheet, int width, int picture) {
    Red red;
    for (int y = 0; y < sheet.height; ++y) {
        for (int x = 0; x < width; ++x) {
            const glm::u8vec4 colour = sheet.at(picture * width + x, y);
            if (colour.r > 60 && colour.r > 2 * colour.b) {
                ++red.texels;
                red.row += y;
            }
        }
    }
    red.row /= static_cast<double>(std::max<std::size_t>(red.texels, 1));
    return red;
}

bool are_equal(const BehaviourPictures& pictures, int a, int b) {
    for (int y = 0; y < pictures.size.y; ++y) {
        for (int x = 0; x < pictures.size.x; ++x) {
            if (pictures.sheet.at(a * pictures.size.x + x, y) !=
                pictures.sheet.at(b * pictures.size.x + x, y)) {
                return false;
            }
        }
    }
    return true;
}

class Behaviours : public CuratorFolder {
protected:
    void SetUp() override {
        put("box/box.gltf", box_gltf());
        put("box/artifact.toml", "scan = \"box.gltf\"\nsize = 32\nunlit = true\n[placement]\nturn_deg = 0.0\n"
                                 "scale = 0.5\n[[texts]]\nlanguage = \"en\"\n");
    }
};

TEST_F(Behaviours, AreDrawnAtEqualStepsOfTheirTime) {
    ASSERT_EQ(run("frustumscreen-bake box -o box.fspack"), 0) << text("err.txt");
    TurnOptions options;
    options.size = {400, 280};
    options.projected_width = 960;
    const Result<std::vector<BehaviourPictures>> drawn = behaviour_pictures(folder / "box.fspack", options);
    ASSERT_TRUE(drawn) << drawn.error().message;
    ASSERT_EQ(drawn->size(), 1U);
    const BehaviourPictures& pictures = drawn->front();
    EXPECT_EQ(pictures.behaviour.behaviour.name, "jump");
    ASSERT_EQ(pictures.frames, 8);
    EXPECT_DOUBLE_EQ(pictures.step_s, 2.0 / 7.0);
    EXPECT_EQ(pictures.size, glm::ivec2(200, 140));
    EXPECT_EQ(pictures.sheet.width, 1600);
    for (const int picture : {1, 2, 3}) {
        EXPECT_TRUE(are_equal(pictures, picture, 0)) << picture;
        EXPECT_TRUE(are_equal(pictures, picture + 4, 4)) << picture;
    }
    const Red before = red_in(pictures.sheet, pictures.size.x, 0);
    const Red after = red_in(pictures.sheet, pictures.size.x, 7);
    EXPECT_GT(before.texels, 50U);
    EXPECT_GT(after.texels, 50U);
    EXPECT_LT(after.row, before.row - 3.0) << "rows go down";
}

TEST_F(Behaviours, AreOnThePageOfABake) {
    ASSERT_EQ(run("frustumscreen-bake box -o box.fspack --preview box.html --while-watched"), 0)
        << text("err.txt");
    const std::string page = text("box.html");
    EXPECT_NE(page.find("<b>jump</b>, 2.0 s, begins by the button for it"), std::string::npos);
    EXPECT_EQ(count("box.html", "class=\"behaviour\""), 1U);
    ASSERT_EQ(
        run("frustumscreen-bake box -o box.fspack --force --cells none --preview box.html --while-watched"),
        0)
        << text("err.txt");
    EXPECT_EQ(count("box.html", "class=\"behaviour\""), 0U);
    EXPECT_EQ(text("box.html").find("What moves"), std::string::npos);
}

constexpr const char* box_states = R"(
[[states]]
name = "as-found"
titles = { en = "As found", de = "Wie <gefunden>" }
[[states]]
name = "lidless"
hide = ["lid"]
titles = { en = "Without its lid" }
[[states]]
name = "thrown"
behaviour = "jump"
titles = { en = "Thrown up" }
)";

TEST_F(Behaviours, StatesHavePicturesOnThePreviewPage) {
    put("box/artifact.toml", text("box/artifact.toml") + box_states);
    ASSERT_EQ(run("frustumscreen-bake box -o box.fspack --preview box.html --while-watched"), 0)
        << text("err.txt");
    const pack::VerifiedPack pack = pack::load_pack(folder / "box.fspack").value();
    TurnOptions options;
    options.size = {400, 280};
    options.projected_width = 960;
    const Result<std::vector<StatePicture>> drawn = state_pictures(folder / "box.fspack", *pack, options);
    ASSERT_TRUE(drawn) << drawn.error().message;
    ASSERT_EQ(drawn->size(), 3U);
    const auto red = [&](std::size_t state) { return red_in((*drawn)[state].picture, 200, 0); };
    EXPECT_EQ((*drawn)[0].state.name, "as-found");
    EXPECT_GT(red(0).texels, 50U);
    EXPECT_EQ(red(1).texels, 0U) << "the lid is hidden";
    EXPECT_GT(red(2).texels, 50U);
    EXPECT_LT(red(2).row, red(0).row - 3.0) << "rows go down";

    EXPECT_EQ(count("box.html", "class=\"state\""), 3U);
    EXPECT_NE(text("box.html").find("Wie &lt;gefunden&gt;"), std::string::npos);
    EXPECT_EQ(
        std::system(fmt::format("'{}/tests/preview/check_page.py' '{}/box.html' --reloads --text 'Thrown up'",
                                source_dir(), folder.string())
                        .c_str()),
        0);
}

} // namespace
} // namespace frustumscreen::programs
