#include "assets_baked/artifacts/write_glb.h"
#include "firmware_host/base/json.h"

#include <gtest/gtest.h>

#include <cstring>
#include <memory>
#include <string>

namespace frustumscreen::artifacts {
namespace {

/// Two triangles with two materials, one of them a texture.
bake::SourceMesh small_mesh() {
    bake::SourceMesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 2, 0}, {0, 0, -3.5}};
    mesh.uvs = {{0, 0}, {1, 0}, {0, 1}, {0.25F, 0.75F}};
    mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
    mesh.triangle_materials = {1, 0};
    mesh.materials = {{.base_colour = {0.5F, 0.25F, 0.125F, 1.0F}},
                      {.texture = 0, .alpha_mask = true, .alpha_cutoff = 0.25F}};
    mesh.textures = {{std::make_shared<const image::Image8>(3, 2, glm::u8vec4(10, 20, 30, 255)),
                      bake::Wrap::Mirror, bake::Wrap::Clamp}};
    return mesh;
}

std::uint32_t word(const Bytes& bytes, std::size_t at) {
    std::uint32_t value = 0;
    std::memcpy(&value, bytes.data() + at, sizeof(value));
    return value;
}

struct Glb {
    nlohmann::json json;
    Bytes binary;
};

Glb parse(const Bytes& bytes) {
    EXPECT_EQ(word(bytes, 0), 0x46546C67U);
    EXPECT_EQ(word(bytes, 4), 2U);
    EXPECT_EQ(word(bytes, 8), bytes.size());
    const std::size_t json_length = word(bytes, 12);
    EXPECT_EQ(json_length % 4, 0U);
    const std::string text(reinterpret_cast<const char*>(bytes.data()) + 20, json_length);
    const std::size_t binary_at = 20 + json_length;
    EXPECT_EQ(word(bytes, binary_at + 4), 0x004E4942U);
    EXPECT_EQ(binary_at + 8 + word(bytes, binary_at), bytes.size());
    return {nlohmann::json::parse(text),
            Bytes(bytes.begin() + static_cast<std::ptrdiff_t>(binary_at + 8), bytes.end())};
}

template <typename Value>
Value read(const Glb& glb, int accessor, std::size_t element, std::size_t component) {
    const auto& entry = glb.json["accessors"][static_cast<std::size_t>(accessor)];
    const auto& view = glb.json["bufferViews"][entry["bufferView"].get<std::size_t>()];
    const std::string type = entry["type"];
    const std::size_t width = type == "SCALAR" ? 1 : type == "VEC2" ? 2 : 3;
    Value value{};
    std::memcpy(&value,
                glb.binary.data() + view["byteOffset"].get<std::size_t>() +
                    (element * width + component) * sizeof(Value),
                sizeof(Value));
    return value;
}

} // namespace

TEST(WriteGlb, HoldsEveryVertexAndTriangle) {
    const bake::SourceMesh mesh = small_mesh();
    const Glb glb = parse(*write_glb(mesh));
    const auto& primitives = glb.json["meshes"][0]["primitives"];
    ASSERT_EQ(primitives.size(), 2U);
    for (const auto& primitive : primitives) {
        const std::size_t triangle = primitive["material"] == 1 ? 0 : 1;
        for (std::size_t corner = 0; corner < 3; ++corner) {
            const auto vertex = read<std::uint32_t>(glb, primitive["indices"], corner, 0);
            ASSERT_EQ(vertex, mesh.triangles[triangle][corner]);
            for (std::size_t axis = 0; axis < 3; ++axis) {
                EXPECT_EQ(read<float>(glb, primitive["attributes"]["POSITION"], vertex, axis),
                          static_cast<float>(mesh.positions[vertex][static_cast<int>(axis)]));
            }
            EXPECT_EQ(read<float>(glb, primitive["attributes"]["TEXCOORD_0"], vertex, 1), mesh.uvs[vertex].y);
        }
    }
    EXPECT_EQ(glb.json["accessors"][0]["min"], nlohmann::json({0.0, 0.0, -3.5}));
    EXPECT_EQ(glb.json["accessors"][0]["max"], nlohmann::json({1.0, 2.0, 0.0}));
    EXPECT_EQ(glb.json["scenes"][0]["nodes"], nlohmann::json::array({0}));
    EXPECT_EQ(glb.json["nodes"][0]["mesh"], 0);
}

TEST(WriteGlb, HoldsMaterialsAndTheTextureAsPng) {
    const Glb glb = parse(*write_glb(small_mesh()));
    EXPECT_EQ(glb.json["materials"][0]["pbrMetallicRoughness"]["baseColorFactor"],
              nlohmann::json({0.5, 0.25, 0.125, 1.0}));
    EXPECT_EQ(glb.json["materials"][1]["alphaMode"], "MASK");
    EXPECT_EQ(glb.json["materials"][1]["alphaCutoff"], 0.25);
    EXPECT_EQ(glb.json["samplers"][0]["wrapS"], 33648);
    EXPECT_EQ(glb.json["samplers"][0]["wrapT"], 33071);
    const auto& view = glb.json["bufferViews"][glb.json["images"][0]["bufferView"].get<std::size_t>()];
    const auto first = glb.binary.begin() + view["byteOffset"].get<std::ptrdiff_t>();
    const auto image = image::decode_png8(Bytes(first, first + view["byteLength"].get<std::ptrdiff_t>()));
    ASSERT_TRUE(image.has_value());
    EXPECT_EQ(image->width, 3);
    EXPECT_EQ(image->height, 2);
    EXPECT_EQ(image->at(2, 1), glm::u8vec4(10, 20, 30, 255));
}

TEST(WriteGlb, EveryViewIsAlignedAndInsideTheBuffer) {
    const Glb glb = parse(*write_glb(small_mesh()));
    const auto length = glb.json["buffers"][0]["byteLength"].get<std::size_t>();
    EXPECT_LE(length, glb.binary.size());
    for (const auto& view : glb.json["bufferViews"]) {
        EXPECT_EQ(view["byteOffset"].get<std::size_t>() % 4, 0U);
        EXPECT_LE(view["byteOffset"].get<std::size_t>() + view["byteLength"].get<std::size_t>(), length);
    }
}

} // namespace frustumscreen::artifacts
