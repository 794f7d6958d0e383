#include "tests/loaders/loaders_testing.h"
#include "tests/loaders/sample_models.h"
#include "tests/loaders/sample_pictures.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

namespace frustumscreen::testing {
namespace {

const std::string triangle_bytes = bytes_of(std::vector<float>{0, 0, 0, 1, 0, 0, 0, 1, 0});
constexpr std::string_view one_view =
    R"("bufferViews":[{"buffer":0,"byteLength":36}],"accessors":[{"bufferView":0,"componentType":5126,"type":"VEC3","count":3}])";
constexpr std::string_view one_mesh = R"("meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}])";

/// A triangle with corners at 0, x, y; `members` add nodes and scenes.
std::string triangle_with(std::string_view members) {
    return gltf_text(triangle_bytes, fmt::format("{},{}{}", one_view, one_mesh, members));
}

bake::SourceMesh mesh_of(const std::string& text) {
    return sound(load_text("model.gltf", text));
}

std::string replaced(std::string text, std::string_view from, std::string_view to) {
    const std::size_t place = text.find(from);
    EXPECT_NE(place, std::string::npos) << from;
    return text.replace(place, from.size(), to);
}

glm::dvec3 normal_of(const bake::SourceMesh& mesh, std::size_t triangle) {
    const auto& [a, b, c] = mesh.triangles[triangle];
    return glm::cross(mesh.positions[b] - mesh.positions[a], mesh.positions[c] - mesh.positions[a]);
}

TEST(Gltf, TransformsMultiplyFromTheRootDown) {
    // Root: twice as large, moved to x = 10. Child: a quarter turn about z (x to y), moved to z = 1.
    const double half = std::sqrt(0.5);
    const bake::SourceMesh mesh = mesh_of(triangle_with(fmt::format(
        R"(,"nodes":[{{"scale":[2,2,2],"translation":[10,0,0],"children":[1]}},)"
        R"({{"rotation":[0,0,{},{}],"translation":[0,0,1],"mesh":0}}],"scenes":[{{"nodes":[0]}}])",
        half, half)));
    EXPECT_LT(glm::length(mesh.positions[0] - glm::dvec3(10, 0, 2)), 1e-12);
    EXPECT_LT(glm::length(mesh.positions[1] - glm::dvec3(10, 2, 2)), 1e-12);
    EXPECT_LT(glm::length(mesh.positions[2] - glm::dvec3(8, 0, 2)), 1e-12);
}

TEST(Gltf, MirroringNodeKeepsTheTriangleOrientation) {
    const bake::SourceMesh plain =
        mesh_of(triangle_with(R"(,"nodes":[{"mesh":0}],"scenes":[{"nodes":[0]}])"));
    const bake::SourceMesh mirrored = mesh_of(triangle_with(
        R"(,"nodes":[{"mesh":0,"matrix":[-1,0,0,0, 0,1,0,0, 0,0,1,0, 0,0,0,1]}],"scenes":[{"nodes":[0]}])"));
    EXPECT_GT(normal_of(plain, 0).z, 0.0);
    EXPECT_GT(normal_of(mirrored, 0).z, 0.0);
}

TEST(Gltf, UsesTheDefaultSceneElseTheFirstElseAllNodes) {
    const std::string nodes =
        R"(,"nodes":[{"mesh":0},{"mesh":0,"translation":[0,0,1]},{"mesh":0,"translation":[0,0,2]}])";
    const std::string scenes = R"(,"scenes":[{"nodes":[1]},{"nodes":[0,2]}])";
    EXPECT_EQ(mesh_of(triangle_with(nodes + scenes)).positions[0].z, 1.0);
    EXPECT_EQ(mesh_of(triangle_with(nodes + scenes + R"(,"scene":1)")).triangles.size(), 2U);
    EXPECT_EQ(mesh_of(triangle_with(nodes)).triangles.size(), 3U);
    EXPECT_EQ(mesh_of(triangle_with("")).triangles.size(), 1U);
}

TEST(Gltf, TriangulatesFansAndStripsByTheStandard) {
    const std::string bytes = bytes_of(std::vector<float>{0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0});
    const auto text = [&](int mode) {
        return gltf_text(
            bytes,
            fmt::format(R"("bufferViews":[{{"buffer":0,"byteLength":48}}],)"
                        R"("accessors":[{{"bufferView":0,"componentType":5126,"type":"VEC3","count":4}}],)"
                        R"("meshes":[{{"primitives":[{{"mode":{},"attributes":{{"POSITION":0}}}}]}}])",
                        mode));
    };
    const bake::SourceMesh fan = mesh_of(text(6));
    ASSERT_EQ(fan.triangles.size(), 2U);
    EXPECT_NEAR(normal_of(fan, 0).z + normal_of(fan, 1).z, 2.0, 1e-12) << "the square, counter-clockwise";
    const bake::SourceMesh strip = mesh_of(text(5));
    ASSERT_EQ(strip.triangles.size(), 2U);
    // Corners 0 1 2, then 1 3 2: the second triangle crosses the square and faces the other way.
    EXPECT_NEAR(normal_of(strip, 0).z, 1.0, 1e-12);
    EXPECT_NEAR(normal_of(strip, 1).z, -1.0, 1e-12);
    EXPECT_NE(error_of(load_text("model.gltf", text(1))).find("[mesh.point_cloud]"), std::string::npos);
}

TEST(Gltf, ReadsNormalisedIntegersAndStrides) {
    // 16 bytes per vertex: signed 16-bit position, padding, 8-bit colour.
    std::string bytes;
    for (const std::array<std::int16_t, 4>& p :
         {std::array<std::int16_t, 4>{-32768, 0, 0, 0}, std::array<std::int16_t, 4>{32767, 0, 0, 0},
          std::array<std::int16_t, 4>{0, 16384, 0, 0}}) {
        bytes += bytes_of(std::vector<std::int16_t>(p.begin(), p.end())) +
                 std::string("\xff\x33\x00\x00", 4) + std::string(4, '\0');
    }
    const std::string text = gltf_text(
        bytes,
        R"("extensionsRequired":["KHR_mesh_quantization"],"bufferViews":[{"buffer":0,"byteLength":48,"byteStride":16}],)"
        R"("accessors":[{"bufferView":0,"componentType":5122,"normalized":true,"type":"VEC3","count":3},)"
        R"({"bufferView":0,"byteOffset":8,"componentType":5121,"normalized":true,"type":"VEC3","count":3}],)"
        R"("meshes":[{"primitives":[{"attributes":{"POSITION":0,"COLOR_0":1}}]}])");
    const bake::SourceMesh mesh = mesh_of(text);
    EXPECT_EQ(mesh.positions[0].x, -1.0) << "-32768 is -1 too";
    EXPECT_EQ(mesh.positions[1].x, 1.0);
    EXPECT_NEAR(mesh.positions[2].y, 16384.0 / 32767.0, 1e-15);
    EXPECT_EQ(mesh.colours[0], glm::vec4(1.0F, 0.2F, 0.0F, 1.0F));
    const std::string undeclared = replaced(text, R"("extensionsRequired":["KHR_mesh_quantization"],)", "");
    EXPECT_NE(error_of(load_text("model.gltf", undeclared)).find("KHR_mesh_quantization"), std::string::npos);
}

TEST(Gltf, NodeMorphWeightsOverrideMeshMorphWeights) {
    const std::string text = gltf_text(
        triangle_bytes,
        std::string(one_view) +
            R"(,"meshes":[{"weights":[1],"primitives":[{"attributes":{"POSITION":0},"targets":[{"POSITION":0}]}]}],)"
            R"("nodes":[{"mesh":0},{"mesh":0,"weights":[2.5]}],"scenes":[{"nodes":[0,1]}])");
    const bake::SourceMesh mesh = mesh_of(text);
    EXPECT_EQ(mesh.positions[1].x, 2.0);
    EXPECT_EQ(mesh.positions[4].x, 3.5);
}

TEST(Gltf, SkinBlendsItsJointsByWeight) {
    std::string bytes = triangle_bytes;
    bytes += bytes_of(std::vector<std::uint8_t>{0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0});        // joints at 36
    bytes += bytes_of(std::vector<std::uint8_t>{255, 0, 0, 0, 255, 0, 0, 0, 51, 204, 0, 0}); // weights at 48
    const bake::SourceMesh mesh = mesh_of(gltf_text(
        bytes,
        R"("bufferViews":[{"buffer":0,"byteLength":60}],"accessors":[)"
        R"({"bufferView":0,"componentType":5126,"type":"VEC3","count":3},)"
        R"({"bufferView":0,"byteOffset":36,"componentType":5121,"type":"VEC4","count":3},)"
        R"({"bufferView":0,"byteOffset":48,"componentType":5121,"normalized":true,"type":"VEC4","count":3}],)"
        R"("meshes":[{"primitives":[{"attributes":{"POSITION":0,"JOINTS_0":1,"WEIGHTS_0":2}}]}],)"
        R"("skins":[{"joints":[1,2]}],"nodes":[{"mesh":0,"skin":0,"translation":[99,0,0]},)"
        R"({"translation":[0,0,1]},{"translation":[0,0,11]}],"scenes":[{"nodes":[0,1,2]}])"));
    EXPECT_EQ(mesh.positions[0], glm::dvec3(0, 0, 1)) << "the node's own transform does not count";
    EXPECT_EQ(mesh.positions[1], glm::dvec3(1, 0, 11));
    EXPECT_LT(glm::length(mesh.positions[2] - glm::dvec3(0, 1, 0.2 * 1 + 0.8 * 11)), 1e-12);
}

TEST(Gltf, DecodesDracoAndMeshopt) {
    for (const auto& [glb, tolerance] :
         {std::pair(draco_glb(9, true), 1.0 / 4096), std::pair(draco_glb(9, false), 1.0 / 4096),
          std::pair(meshopt_glb(9), 1e-5)}) {
        const Result<bake::SourceMesh> mesh = load_text("grid.glb", glb);
        ASSERT_TRUE(mesh.has_value()) << mesh.error().message;
        expect_sound(*mesh);
        EXPECT_EQ(mesh->triangles.size(), 162U);
        EXPECT_EQ(mesh->positions.size(), 100U);
        for (std::size_t i = 0; i < mesh->triangles.size(); ++i) {
            EXPECT_GT(normal_of(*mesh, i).z, 0.0);
        }
        for (const glm::dvec3& p : mesh->positions) {
            EXPECT_NEAR(p.z, p.x * p.x + p.y * p.y, 6 * tolerance);
            EXPECT_NEAR(p.x * 9, std::round(p.x * 9), 18 * tolerance);
        }
    }
}

TEST(Gltf, LimitsRepeatedDecodingOfAPackedStream) {
    std::string glb = draco_glb(5, true);
    const std::string attributes = R"("attributes":{"POSITION":0}}}})";
    ASSERT_NE(glb.find(attributes), std::string::npos);
    const std::size_t begin = glb.find(R"({"attributes":{"POSITION":0})");
    const std::string primitive = glb.substr(begin, glb.find(attributes) + attributes.size() - begin);
    const auto doubled = [&](std::string second) {
        const std::size_t json_end = 20 + *reinterpret_cast<const std::uint32_t*>(glb.data() + 12);
        std::string json = glb.substr(20, json_end - 20);
        json.insert(json.find(primitive), second + ",");
        return glb_bytes(json, glb.substr(json_end + 8));
    };
    EXPECT_TRUE(load_text("twice.glb", doubled(primitive)).has_value()) << "the same use is unpacked once";
    const std::string other = replaced(primitive, attributes, R"("attributes":{"POSITION":0,"NORMAL":0}}}})");
    EXPECT_NE(error_of(load_text("twice.glb", doubled(other))).find("again and again"), std::string::npos);
}

TEST(Gltf, TextureTransformRotatesCounterClockwise) {
    std::string bytes = triangle_bytes + bytes_of(std::vector<float>{0, 0, 1, 0, 0, 1});
    const std::size_t picture_at = bytes.size();
    const std::string picture = png_of(smooth_picture(2, 2));
    const bake::SourceMesh mesh = mesh_of(gltf_text(
        bytes + picture,
        fmt::format(
            R"("bufferViews":[{{"buffer":0,"byteLength":60}},{{"buffer":0,"byteOffset":{},"byteLength":{}}}],)"
            R"("accessors":[{{"bufferView":0,"componentType":5126,"type":"VEC3","count":3}},)"
            R"({{"bufferView":0,"byteOffset":36,"componentType":5126,"type":"VEC2","count":3}}],)"
            R"("images":[{{"bufferView":1}}],"textures":[{{"source":0}}],"materials":[{{"pbrMetallicRoughness":)"
            R"({{"baseColorTexture":{{"index":0,"texCoord":7,"extensions":{{"KHR_texture_transform":)"
            R"({{"offset":[0,1],"rotation":1.5707963267948966,"scale":[0.5,0.5],"texCoord":1}}}}}}}}}}],)"
            R"("meshes":[{{"primitives":[{{"material":0,"attributes":{{"POSITION":0,"TEXCOORD_1":1}}}}]}}])",
            picture_at, picture.size())));
    // The extension's own example: the lower left quadrant of the picture.
    EXPECT_LT(glm::length(mesh.uvs[0] - glm::vec2(0.0F, 1.0F)), 1e-6F);
    EXPECT_LT(glm::length(mesh.uvs[1] - glm::vec2(0.0F, 0.5F)), 1e-6F);
    EXPECT_LT(glm::length(mesh.uvs[2] - glm::vec2(0.5F, 1.0F)), 1e-6F);
}

TEST(Gltf, SidecarsMustLieBesideTheModel) {
    const std::string text = triangle_with("");
    const std::size_t begin = text.find("data:");
    const auto with_uri = [&](std::string_view uri) {
        return text.substr(0, begin) + std::string(uri) + text.substr(text.find('"', begin));
    };
    const TemporaryFolder folder;
    folder.write("parts/my data.bin", triangle_bytes);
    folder.write("short.bin", triangle_bytes.substr(0, 35));
    EXPECT_TRUE(bake::load_mesh(folder.write("model.gltf", with_uri("parts/my%20data.bin"))).has_value());
    EXPECT_TRUE(
        bake::load_mesh(folder.write("model.gltf", with_uri("parts/../parts/my data.bin"))).has_value());
    for (const auto& [uri, expected] : std::vector<std::pair<std::string, std::string>>{
             {"gone.bin", "\"gone.bin\", but there is no such file beside it"},
             {"short.bin", "36 bytes are declared, but there are only 35"},
             {"parts", "\"parts\", but there is no such file beside it"},
             {"../model.bin", "\"model.bin\", but there is no such file beside it"},
             {"%2e%2e/model.bin", "\"model.bin\", but there is"},
             {"..\\\\model.bin", "\"model.bin\", but there is"},
             {"/etc/hostname", "\"hostname\", but there is"},
             {"file:///etc/hostname", "\"hostname\", but there is"},
             {"https://example.org/a.bin", "\"a.bin\", but there is"},
             {"a%zz.bin", "hexadecimal"},
             {"", "the file \"\", but there is no such file beside it"},
             {"data:application/octet-stream,abc", "not base64"},
             {"data:application/octet-stream;base64,A*==", "damaged"}}) {
        const std::string error = error_of(bake::load_mesh(folder.write("model.gltf", with_uri(uri))));
        EXPECT_NE(error.find(expected), std::string::npos) << error;
        EXPECT_NE(error.find("buffers[0]"), std::string::npos) << error;
    }
}

TEST(Gltf, RefusalsNameThePlace) {
    const std::string text = triangle_with(R"(,"nodes":[{"mesh":0}],"scenes":[{"nodes":[0]}])");
    for (const auto& [from, to, expected] : std::vector<std::array<std::string, 3>>{
             {R"("bufferView":0)", R"("bufferView":7)",
              "accessors[0].bufferView: 7 is out of range, the file has 1"},
             {R"("bufferView":0)", R"("bufferView":-1)", "accessors[0].bufferView: -1 is out of range"},
             {R"("bufferView":0)", R"("bufferView":"0")",
              "accessors[0].bufferView: a whole number is expected, not \"0\""},
             {R"("bufferView":0)", R"("bufferView":0.5)",
              "accessors[0].bufferView: a whole number is expected"},
             {R"("count":3)", R"("count":4)", "accessors[0]: 4 elements of 12 bytes"},
             {R"("count":3)", R"("count":9007199254740991)", "accessors[0].count"},
             {R"("count":3)", R"("count":4294967296)", "accessors[0]: 4294967296 elements"},
             {R"("count":3)", R"("count":0)", "accessors[0].count: 0 is out of range"},
             {R"("byteLength":36}])", R"("byteLength":37}])",
              "bufferViews[0]: bytes 0 to 37 are out of range"},
             {R"("byteLength":36}])", R"("byteLength":36,"byteOffset":9007199254740992}])", "bufferViews[0]"},
             {R"("componentType":5126)", R"("componentType":5124)", "accessors[0].componentType"},
             {R"("VEC3")", R"("VEC5")", "accessors[0].type: \"VEC5\" is not known"},
             {R"("VEC3")", R"("VEC2")", "meshes[0].primitives[0].attributes.POSITION"},
             {R"("POSITION":0})", R"("POSITION":0},"indices":0)", "indices"},
             {R"("POSITION":0})", R"("POSITION":0},"mode":9)", "meshes[0].primitives[0].mode"},
             {R"("POSITION":0})", R"("POSITION":0},"material":0)",
              "meshes[0].primitives[0].material: 0 is out of range, the file has 0"},
             {R"("nodes":[{"mesh":0}])", R"("nodes":[{"mesh":0,"children":[0]}])", "own ancestor"},
             {R"("nodes":[{"mesh":0}])", R"("nodes":[{"children":[2]},{"children":[2]},{"mesh":0}])",
              "one parent is allowed"},
             {R"("nodes":[{"mesh":0}])", R"("nodes":[{"mesh":0,"scale":[1e300,1e300,1e300]}])", "vertex 1"},
             {R"("nodes":[{"mesh":0}])", R"("nodes":[{"mesh":0,"rotation":[0,0,0,0]}])", "nodes[0].rotation"},
             {R"("nodes":[{"mesh":0}])", R"("nodes":[{"mesh":0,"translation":[0,0]}])",
              "nodes[0].translation: 3 numbers"},
             {R"("nodes":[{"mesh":0}])", R"("nodes":{"mesh":0})", "nodes: an array is expected"},
             {R"("scenes":[{"nodes":[0]}])", R"("scenes":[{"nodes":[]}])", "no triangles"},
             {R"("asset":)", R"("extensionsRequired":["NEW_magic"],"asset":)",
              "the extension NEW_magic of glTF, which is not supported"},
             {R"({"version":"2.0"})", "{}", "asset: \"version\" is missing"},
             {R"("asset":)", R"("asset":[)", "(JSON: parse error at line 1"}}) {
        SCOPED_TRACE(to);
        const std::string error = error_of(load_text("model.gltf", replaced(text, from, to)));
        EXPECT_NE(error.find(expected), std::string::npos) << error;
    }
}

TEST(Gltf, ReadsAChainOfAHundredThousandNodes) {
    std::string nodes;
    constexpr int count = 100'000;
    for (int i = 0; i + 1 < count; ++i) {
        nodes += fmt::format(R"({{"children":[{}]}},)", i + 1);
    }
    EXPECT_EQ(
        mesh_of(triangle_with(fmt::format(R"(,"nodes":[{}{{"mesh":0}}],"scenes":[{{"nodes":[0]}}])", nodes)))
            .triangles.size(),
        1U);
}

TEST(Gltf, RejectsExcessiveInstancesAndPositionsWithoutData) {
    std::string nodes;
    for (int i = 0; i < 180; ++i) {
        nodes += i == 0 ? R"({"mesh":0})" : R"(,{"mesh":0})";
    }
    const std::string text = fmt::format(
        R"({{"asset":{{"version":"2.0"}},"accessors":[{{"componentType":5126,"type":"VEC3","count":1048576}}],)"
        R"("meshes":[{{"primitives":[{{"attributes":{{"POSITION":0}}}}]}}],"nodes":[{}]}})",
        nodes);
    EXPECT_NE(error_of(load_text("model.gltf", text)).find("more than 60000000 triangles"),
              std::string::npos);
    const std::string zeros = replaced(text, "1048576", "1048577");
    EXPECT_NE(error_of(load_text("model.gltf", zeros.substr(0, zeros.find(",{\"mesh\"")) + "]}"))
                  .find("positions without data"),
              std::string::npos);
}

TEST(Gltf, AnIndexBeyondTheVerticesIsRefused) {
    const std::string bytes = triangle_bytes + bytes_of(std::vector<std::uint16_t>{0, 1, 3, 0});
    const std::string text = gltf_text(
        bytes, R"("bufferViews":[{"buffer":0,"byteLength":36},{"buffer":0,"byteOffset":36,"byteLength":8}],)"
               R"("accessors":[{"bufferView":0,"componentType":5126,"type":"VEC3","count":3},)"
               R"({"bufferView":1,"componentType":5123,"type":"SCALAR","count":3}],)"
               R"("meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1}]}])");
    EXPECT_NE(
        error_of(load_text("model.gltf", text)).find("indices: element 2 is 3, but POSITION has 3 vertices"),
        std::string::npos);
}

TEST(Gltf, RejectsADamagedOrMissingPictureThatIsUsed) {
    const TemporaryFolder folder;
    folder.write("torn.png", png_of(smooth_picture(8, 8)).substr(0, 60));
    const std::string text = triangle_with(
        R"(,"images":[{"uri":"torn.png"}],"textures":[{"source":0}],"materials":[{"pbrMetallicRoughness":{"baseColorTexture":{"index":0}}}])");
    const std::string used = replaced(text, R"("POSITION":0})", R"("POSITION":0},"material":0)");
    EXPECT_TRUE(bake::load_mesh(folder.write("model.gltf", text)).has_value())
        << "nothing shows it, so it is not read";
    EXPECT_NE(error_of(bake::load_mesh(folder.write("model.gltf", used))).find("the PNG picture is damaged"),
              std::string::npos);
    EXPECT_NE(error_of(bake::load_mesh(folder.write("model.gltf", replaced(used, "torn", "gone"))))
                  .find("\"gone.png\" is not beside it"),
              std::string::npos);
}

} // namespace
} // namespace frustumscreen::testing
