// glTF as exporters write it: emission as colour, instances, hidden parts, transparency, extensions.
#include "app/image/image.h"
#include "tests/loaders/loaders_testing.h"
#include "tests/loaders/sample_pictures.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>

namespace frustumscreen::testing {
namespace {

/// A triangle with texture coordinates, and rows of two instances: places (0, 0, 0) and (5, 0, 0), a quarter turn about
/// z for the second, scales 1 and 2.
const std::string bytes =
    bytes_of(std::vector<float>{0, 0, 0, 1, 0, 0, 0,           1,           0, // 0: positions
                                0, 0, 1, 0, 0, 1,                              // 36: uv
                                0, 0, 0, 5, 0, 0,                              // 60: translations
                                0, 0, 0, 1, 0, 0, 0.70710678F, 0.70710678F,    // 84: rotations
                                1, 1, 1, 2, 2, 2});                            // 116: scales
constexpr std::string_view accessors =
    R"("bufferViews":[{"buffer":0,"byteLength":36},{"buffer":0,"byteOffset":36,"byteLength":24},{"buffer":0,"byteOffset":60,"byteLength":24},)"
    R"({"buffer":0,"byteOffset":84,"byteLength":32},{"buffer":0,"byteOffset":116,"byteLength":24}],)"
    R"("accessors":[{"bufferView":0,"componentType":5126,"type":"VEC3","count":3},{"bufferView":1,"componentType":5126,"type":"VEC2","count":3},)"
    R"({"bufferView":2,"componentType":5126,"type":"VEC3","count":2},{"bufferView":3,"componentType":5126,"type":"VEC4","count":2},)"
    R"({"bufferView":4,"componentType":5126,"type":"VEC3","count":2}])";

bake::SourceMesh mesh_of(const std::string& text) {
    return sound(load_text("model.gltf", text));
}

/// One triangle with one material; picture 0 is `picture`.
bake::SourceMesh with_material(std::string_view material,
                               const image::Image8& picture = image::Image8(1, 1,
                                                                            glm::u8vec4(10, 20, 30, 255)),
                               std::string_view more = "") {
    return mesh_of(gltf_text(
        bytes,
        fmt::format(
            R"({},"images":[{{"uri":"data:image/png;base64,{}"}}],"textures":[{{"source":0}}],"materials":[{}],)"
            R"("meshes":[{{"primitives":[{{"attributes":{{"POSITION":0,"TEXCOORD_0":1}},"material":0}}]}}]{})",
            accessors, base64(png_of(picture)), material, more)));
}

bake::SourceMesh with_nodes(std::string_view nodes, std::string_view more = "") {
    return mesh_of(gltf_text(
        bytes,
        fmt::format(
            R"({},"meshes":[{{"primitives":[{{"attributes":{{"POSITION":0}}}}]}}],"nodes":[{}],"scenes":[{{"nodes":[0]}}]{})",
            accessors, nodes, more)));
}

const bake::SourceMaterial& material_of(const bake::SourceMesh& mesh) {
    return mesh.materials[mesh.triangle_materials[0]];
}

TEST(GltfExporters, EmissionReplacesAMissingColour) {
    for (
        const char* material :
        {R"({"pbrMetallicRoughness":{"baseColorFactor":[0,0,0,1]},"emissiveFactor":[1,1,1],"emissiveTexture":{"index":0}})",
         R"({"emissiveFactor":[1,1,1],"emissiveTexture":{"index":0}})",
         R"({"pbrMetallicRoughness":{"baseColorFactor":[0,0,0,1],"baseColorTexture":{"index":0}},"emissiveFactor":[1,1,1],"emissiveTexture":{"index":0}})"}) {
        const bake::SourceMesh mesh = with_material(material);
        EXPECT_EQ(glm::vec3(material_of(mesh).base_colour), glm::vec3(1.0F)) << material;
        EXPECT_EQ(material_of(mesh).texture, 0) << material;
        EXPECT_TRUE(notes(mesh, bake::SourceNote::Kind::Guessed, "own light")) << material;
    }
    EXPECT_EQ(
        glm::vec3(
            material_of(
                with_material(
                    R"({"pbrMetallicRoughness":{"baseColorFactor":[0,0,0,1]},"emissiveFactor":[0.5,0.25,1]})"))
                .base_colour),
        glm::vec3(0.5F, 0.25F, 1.0F));
}

TEST(GltfExporters, ReportsEmissionBesideAColour) {
    const bake::SourceMesh mesh = with_material(
        R"({"pbrMetallicRoughness":{"baseColorTexture":{"index":0}},"emissiveFactor":[1,1,1],"emissiveTexture":{"index":0}})");
    EXPECT_TRUE(notes(mesh, bake::SourceNote::Kind::Lost, "emission"));
    const bake::SourceMesh none = with_material(
        R"({"pbrMetallicRoughness":{"baseColorTexture":{"index":0}},"emissiveTexture":{"index":0}})");
    EXPECT_TRUE(none.notes.empty()) << "without a factor the light is black";
}

TEST(GltfExporters, MarksUnlitMeshesAndReportsMixtures) {
    EXPECT_TRUE(with_material(R"({"extensions":{"KHR_materials_unlit":{}}})").is_unlit);
    EXPECT_FALSE(with_material("{}").is_unlit);
    const bake::SourceMesh mixed = mesh_of(gltf_text(
        bytes,
        fmt::format(
            R"({},"materials":[{{"extensions":{{"KHR_materials_unlit":{{}}}}}},{{}}],"meshes":[{{"primitives":[)"
            R"({{"attributes":{{"POSITION":0}},"material":0}},{{"attributes":{{"POSITION":0}},"material":1}}]}}])",
            accessors)));
    EXPECT_FALSE(mixed.is_unlit);
    EXPECT_TRUE(notes(mixed, bake::SourceNote::Kind::Lost, "unlit"));
}

TEST(GltfExporters, BinaryTransparencyBecomesACutOut) {
    const std::string blend =
        R"({"alphaMode":"BLEND","pbrMetallicRoughness":{"baseColorTexture":{"index":0}}})";
    image::Image8 picture(10, 10, glm::u8vec4(10, 20, 30, 255));
    EXPECT_FALSE(material_of(with_material(blend, picture)).alpha_mask) << "opaque everywhere";
    EXPECT_TRUE(with_material(blend, picture).notes.empty());
    picture.at(3, 3).a = 0;
    const bake::SourceMesh cut = with_material(blend, picture);
    EXPECT_TRUE(material_of(cut).alpha_mask);
    EXPECT_EQ(material_of(cut).alpha_cutoff, 0.5F);
    EXPECT_TRUE(notes(cut, bake::SourceNote::Kind::Guessed, "cut out"));
    for (int y = 0; y < 10; ++y) {
        picture.at(0, y).a = picture.at(1, y).a = 128;
    }
    const bake::SourceMesh glass = with_material(blend, picture);
    EXPECT_FALSE(material_of(glass).alpha_mask);
    EXPECT_TRUE(notes(glass, bake::SourceNote::Kind::Lost, "opaque"));
    EXPECT_TRUE(notes(
        with_material(R"({"alphaMode":"BLEND","pbrMetallicRoughness":{"baseColorFactor":[1,1,1,0.5]}})"),
        bake::SourceNote::Kind::Lost, "opaque"));
}

TEST(GltfExporters, PlacesInstancesByTheirAttributes) {
    const bake::SourceMesh mesh = with_nodes(
        R"({"mesh":0,"translation":[0,0,1],"extensions":{"EXT_mesh_gpu_instancing":{"attributes":{"TRANSLATION":2,"ROTATION":3,"SCALE":4}}}})",
        R"(,"extensionsUsed":["EXT_mesh_gpu_instancing"],"extensionsRequired":["EXT_mesh_gpu_instancing"])");
    ASSERT_EQ(mesh.triangles.size(), 2U);
    EXPECT_LT(glm::length(mesh.positions[mesh.triangles[0][1]] - glm::dvec3(1, 0, 1)), 1e-6);
    EXPECT_LT(glm::length(mesh.positions[mesh.triangles[1][0]] - glm::dvec3(5, 0, 1)), 1e-6);
    EXPECT_LT(glm::length(mesh.positions[mesh.triangles[1][1]] - glm::dvec3(5, 2, 1)), 1e-6)
        << "scaled, then turned, then moved";
    EXPECT_TRUE(mesh.notes.empty());
    EXPECT_EQ(
        with_nodes(R"({"mesh":0,"extensions":{"EXT_mesh_gpu_instancing":{"attributes":{"TRANSLATION":2}}}})")
            .triangles.size(),
        2U);
    EXPECT_NE(
        error_of(
            load_text(
                "model.gltf",
                gltf_text(
                    bytes,
                    fmt::format(
                        R"({},"meshes":[{{"primitives":[{{"attributes":{{"POSITION":0}}}}]}}],"nodes":[{{"mesh":0,)"
                        R"("extensions":{{"EXT_mesh_gpu_instancing":{{"attributes":{{"TRANSLATION":3}}}}}}}}])",
                        accessors))))
            .find("rows of 3 numbers"),
        std::string::npos);
}

TEST(GltfExporters, AHiddenNodeHidesAllBelowIt) {
    const std::string below =
        R"(,{"mesh":0},{"children":[3],"extensions":{"KHR_node_visibility":{"visible":false}}},{"mesh":0})";
    const bake::SourceMesh mesh = with_nodes(R"({"children":[1,2]})" + below);
    EXPECT_EQ(mesh.triangles.size(), 1U);
    EXPECT_TRUE(notes(mesh, bake::SourceNote::Kind::Guessed, "2 parts are left out"));
    EXPECT_TRUE(
        with_nodes(R"({"mesh":0,"extensions":{"KHR_node_visibility":{"visible":true}}})").notes.empty());
}

TEST(GltfExporters, ReportsUnsupportedExtensions) {
    EXPECT_TRUE(notes(with_nodes(R"({"mesh":0})", R"(,"extensionsUsed":["ACME_twist"])"),
                      bake::SourceNote::Kind::Lost, "ACME_twist"));
    EXPECT_TRUE(notes(with_nodes(R"({"mesh":0,"extensions":{"ACME_bend":{"by":3}}})"),
                      bake::SourceNote::Kind::Lost, "ACME_bend"))
        << "without a declaration";
    EXPECT_TRUE(with_nodes(R"({"mesh":0,"extras":{"extensions":{"ACME_bend":3}}})").notes.empty());
    EXPECT_TRUE(
        with_nodes(R"({"mesh":0})", R"(,"extensionsUsed":["KHR_materials_specular","KHR_lights_punctual"])")
            .notes.empty())
        << "shine and lamps change no colour";
    const bake::SourceMesh variants = with_nodes(
        R"({"mesh":0})",
        R"(,"extensionsUsed":["KHR_materials_variants"],"extensions":{"KHR_materials_variants":{"variants":[{"name":"gilt"},{"name":"bare"}]}})");
    EXPECT_TRUE(notes(variants, bake::SourceNote::Kind::Lost, "gilt, bare"));
}

/// The text of the note about vertex attributes; the triangle has them besides POSITION. Accessors 0 to 3 are three floats,
/// two floats, one float and four bytes for each corner.
std::string lost_attributes(const std::string& attributes, std::string_view node = R"({"mesh":0})",
                            std::string_view material = "{}") {
    const std::string numbers =
        bytes_of(std::vector<float>{0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 1, 1, 2, 3}) +
        bytes_of(std::vector<std::uint8_t>{0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0});
    const bake::SourceMesh mesh = mesh_of(gltf_text(
        numbers,
        fmt::format(
            R"("bufferViews":[{{"buffer":0,"byteLength":84}}],"accessors":[)"
            R"({{"bufferView":0,"componentType":5126,"type":"VEC3","count":3}},)"
            R"({{"bufferView":0,"byteOffset":36,"componentType":5126,"type":"VEC2","count":3}},)"
            R"({{"bufferView":0,"byteOffset":60,"componentType":5126,"type":"SCALAR","count":3}},)"
            R"({{"bufferView":0,"byteOffset":72,"componentType":5121,"normalized":true,"type":"VEC4","count":3}}],)"
            R"("images":[{{"uri":"data:image/png;base64,{}"}}],"textures":[{{"source":0}}],"materials":[{}],)"
            R"("meshes":[{{"primitives":[{{"attributes":{{"POSITION":0{}}},"material":0}},)"
            R"({{"attributes":{{"POSITION":0{}}},"material":0}}]}}],)"
            R"("skins":[{{"joints":[1]}}],"nodes":[{},{{}}],"scenes":[{{"nodes":[0,1]}}])",
            base64(png_of(image::Image8(1, 1, glm::u8vec4(10, 20, 30, 255)))), material, attributes,
            attributes, node)));
    EXPECT_LE(mesh.notes.size(), 1U);
    return mesh.notes.empty() ? "" : mesh.notes[0].text;
}

// glTF 2.0, 3.7.2.1 and 3.9.2: COLOR_0 multiplies the base colour, a material names its TEXCOORD, TANGENT serves normal maps,
// 3.7.3: JOINTS and WEIGHTS serve the skin of a node, in as many sets of each; names with _ belong to an application.
TEST(GltfExporters, DoesNotReportAttributesWithoutEffect) {
    EXPECT_EQ(lost_attributes(""), "");
    EXPECT_EQ(lost_attributes(R"(,"NORMAL":0,"TANGENT":3,"COLOR_0":3)"), "");
    EXPECT_EQ(lost_attributes(R"(,"TEXCOORD_0":1,"TEXCOORD_1":1)"), "");
    EXPECT_EQ(lost_attributes(R"(,"TEXCOORD_0":1,"TEXCOORD_1":1)", R"({"mesh":0})",
                              R"({"pbrMetallicRoughness":{"baseColorTexture":{"index":0,"texCoord":1}}})"),
              "");
    EXPECT_EQ(lost_attributes(R"(,"JOINTS_0":3,"WEIGHTS_0":3,"JOINTS_1":3,"WEIGHTS_1":3)"), "");
    EXPECT_EQ(lost_attributes(R"(,"JOINTS_0":3,"WEIGHTS_0":3,"JOINTS_1":3,"WEIGHTS_1":3)",
                              R"({"mesh":0,"skin":0})"),
              "");
    EXPECT_EQ(lost_attributes(R"(,"_FEATURE_ID_0":2,"_TEMPERATURE":2)"), "");
}

TEST(GltfExporters, ReportsUnusedColourAndShapeAttributesOnce) {
    const auto begins = [](const std::string& text, const std::string& names) {
        return text.starts_with("the vertex attributes " + names + ": ");
    };
    EXPECT_TRUE(begins(lost_attributes(R"(,"COLOR_0":3,"COLOR_1":3)"), "COLOR_1"));
    EXPECT_TRUE(begins(lost_attributes(R"(,"COLOR_1":0,"_TINT":3,"_ID":2)"), "COLOR_1, _TINT"));
    EXPECT_TRUE(
        begins(lost_attributes(R"(,"JOINTS_0":3,"WEIGHTS_0":3,"JOINTS_1":3)", R"({"mesh":0,"skin":0})"),
               "JOINTS_1"));
    EXPECT_TRUE(begins(lost_attributes(R"(,"JOINTS_1":3,"WEIGHTS_1":3)", R"({"mesh":0,"skin":0})"),
                       "JOINTS_1, WEIGHTS_1"));
}

} // namespace
} // namespace frustumscreen::testing
