#include "app/image/image.h"
#include "tests/loaders/loaders_testing.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace frustumscreen::testing {
namespace {

const std::string square_header = "ply\nformat ascii 1.0\ncomment a square\nelement vertex 4\n"
                                  "property float x\nproperty float y\nproperty float z\n"
                                  "element face 1\nproperty list uchar int vertex_indices\nend_header\n";
const std::string square_data = "0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3\n";

std::string replaced(std::string text, std::string_view from, std::string_view to) {
    const std::size_t place = text.find(from);
    EXPECT_NE(place, std::string::npos) << from;
    return text.replace(place, from.size(), to);
}

template <typename T> std::string binary(T value, bool big) {
    std::string bytes(reinterpret_cast<const char*>(&value), sizeof(T));
    if (big) {
        std::reverse(bytes.begin(), bytes.end());
    }
    return bytes;
}

TEST(Ply, AQuadBecomesTwoTriangles) {
    const Result<bake::SourceMesh> mesh = load_text("square.ply", square_header + square_data);
    ASSERT_TRUE(mesh.has_value()) << mesh.error().message;
    expect_sound(*mesh);
    EXPECT_EQ(mesh->triangles.size(), 2U);
    EXPECT_NEAR(area_of(*mesh), 1.0, 1e-12);
    EXPECT_EQ(mesh->default_up, 'y');
}

TEST(Ply, ReadsOtherLineEndings) {
    for (const std::string_view end : {"\r\n", "\r"}) {
        std::string text = square_header + square_data;
        for (std::size_t i = text.find('\n'); i != std::string::npos; i = text.find('\n', i + end.size())) {
            text.replace(i, 1, end);
        }
        const Result<bake::SourceMesh> mesh = load_text("square.ply", text);
        ASSERT_TRUE(mesh.has_value()) << mesh.error().message;
        EXPECT_EQ(mesh->triangles.size(), 2U);
    }
}

/// Doubles, unsigned short lengths, short indices, an unknown list first and an unknown element between.
std::string awkward_binary(bool big) {
    std::string file =
        fmt::format("ply\nformat binary_{}_endian 1.0\n"
                    "element face 1\nproperty uchar flags\n"
                    "property list ushort short vertex_index\n"
                    "element camera 2\nproperty list uint double view\nproperty char id\n"
                    "element vertex 3\nproperty list uchar float spare\n"
                    "property double z\nproperty double y\nproperty double x\n"
                    "property uchar red\nproperty uchar green\nproperty uchar blue\nend_header\n",
                    big ? "big" : "little");
    file += binary(std::uint8_t{7}, big) + binary(std::uint16_t{3}, big);
    for (const std::int16_t index : {std::int16_t{0}, std::int16_t{1}, std::int16_t{2}}) {
        file += binary(index, big);
    }
    for (const std::uint32_t length : {2U, 0U}) {
        file += binary(length, big) + std::string(length * 8, 'x') + 'i';
    }
    for (const double x : {0.0, 3.0, 0.0}) {
        file += binary(std::uint8_t{1}, big) + binary(5.0F, big);
        file += binary(2.0, big) + binary(x == 0.0 ? 0.0 : 4.0, big) + binary(x, big);
        file += std::string("\x80\xff\x00", 3);
    }
    return file;
}

TEST(Ply, ReadsBothByteOrdersAndSkipsUnknownParts) {
    for (const bool big : {false, true}) {
        const Result<bake::SourceMesh> mesh = load_text("awkward.ply", awkward_binary(big));
        ASSERT_TRUE(mesh.has_value()) << mesh.error().message;
        expect_sound(*mesh);
        ASSERT_EQ(mesh->triangles.size(), 1U);
        EXPECT_EQ(mesh->positions[1], glm::dvec3(3, 4, 2));
        // sRGB code 128 is 0.2158605 of full light.
        EXPECT_NEAR(mesh->colours[0].r, 0.2158605, 1e-6);
        EXPECT_EQ(mesh->colours[0].g, 1.0F);
        EXPECT_EQ(mesh->colours[0].b, 0.0F);
    }
}

TEST(Ply, FloatColoursAreSrgbInZeroToOne) {
    std::string text =
        replaced(square_header, "property float z\n",
                 "property float z\nproperty float red\nproperty float green\nproperty float blue\n");
    text += "0 0 0 0.5 1 0\n1 0 0 1 1 1\n1 1 0 1 1 1\n0 1 0 2 nan -1\n4 0 1 2 3\n";
    const Result<bake::SourceMesh> mesh = load_text("square.ply", text);
    ASSERT_TRUE(mesh.has_value()) << mesh.error().message;
    EXPECT_NEAR(mesh->colours[0].r, 0.2140411, 1e-6);
    expect_sound(*mesh);
}

TEST(Ply, ReadsTriangleStripsWithRestarts) {
    std::string text = replaced(square_header, "element face", "element tristrips");
    text += "0 0 0\n1 0 0\n0 1 0\n1 1 0\n8 0 1 2 3 -1 0 1 3\n";
    const Result<bake::SourceMesh> mesh = load_text("strip.ply", text);
    ASSERT_TRUE(mesh.has_value()) << mesh.error().message;
    ASSERT_EQ(mesh->triangles.size(), 3U);
    for (const auto& [a, b, c] : mesh->triangles) {
        EXPECT_GT(
            glm::cross(mesh->positions[b] - mesh->positions[a], mesh->positions[c] - mesh->positions[a]).z,
            0.0);
    }
}

TEST(Ply, RejectsMalformedFilesInOneLine) {
    const std::string whole = square_header + square_data;
    const std::vector<std::pair<std::string, std::string>> cases = {
        {replaced(whole, "4 0 1 2 3", "4 0 1 2 9"), "vertex 9 is out of range"},
        {replaced(whole, "4 0 1 2 3", "4 0 1 2 -3"), "vertex -3 is out of range"},
        {replaced(whole, "4 0 1 2 3", "4 0 1 2"), "[mesh.cut_short]"},
        {replaced(whole, "4 0 1 2 3", "-4 0 1 2"), "length is -4"},
        {replaced(whole, "4 0 1 2 3", "2.5 0 1 2"), "whole number"},
        {replaced(whole, "4 0 1 2 3", "999999999 0 1 2"), "[mesh.cut_short]"},
        {replaced(whole, "1 1 0", "1 one 0"), "\"one\""},
        {replaced(whole, "1 1 0", "1 nan 0"), "vertex 2"},
        {replaced(whole, "1 1 0", "1 1e999 0"), "vertex 2"},
        {replaced(whole, "vertex 4", "vertex four"), "line 4"},
        {replaced(whole, "vertex 4", "vertex 99999999999"), "[mesh.cut_short]"},
        {replaced(whole, "float x", "real x"), "line 5"},
        {replaced(whole, "property float y\n", ""), "have no y"},
        {replaced(whole, "ascii", "utf8"), "line 2"},
        {replaced(whole, "element face 1", "element face 0"), "[mesh.point_cloud]"},
        {replaced(whole, "list uchar int", "list float int"), "whole number"},
        {square_header.substr(0, square_header.size() - 12), "end_header"},
        {"ply\nformat binary_little_endian 1.0\nelement vertex 4000000000\nproperty float x\n"
         "property float y\nproperty float z\nend_header\n1234",
         "[mesh.cut_short]"},
    };
    for (const auto& [text, expected] : cases) {
        const std::string error = error_of(load_text("square.ply", text));
        EXPECT_NE(error.find(expected), std::string::npos) << error;
        EXPECT_EQ(error.find('\n'), std::string::npos);
        EXPECT_NE(error.find("square.ply"), std::string::npos);
    }
}

/// Two triangles of a square; with `seam`, corners that share a vertex have different texture coordinates.
std::string meshlab_square(bool seam, const std::string& comment) {
    return "ply\nformat ascii 1.0\ncomment VCGLIB generated\n" + comment +
           "element vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
           "element face 2\nproperty list uchar int vertex_indices\nproperty list uchar float texcoord\n"
           "property int texnumber\nend_header\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n"
           "3 0 1 2 6 0 0 1 0 1 1 0\n3 0 2 3 6 " +
           std::string(seam ? "0.5 0.5 0.25 0.25 0 1" : "0 0 1 1 0 1") + " 1\n";
}

TEST(Ply, ReadsMeshLabTexturesAndFaceTextureCoordinates) {
    const TemporaryFolder folder;
    folder.write("my skin.png",
                 as_text(image::encode_png(image::Image8(2, 1, glm::u8vec4(10, 20, 30, 255)))));
    folder.write("other.png", as_text(image::encode_png(image::Image8(1, 1, glm::u8vec4(40, 50, 60, 255)))));
    const std::string comments = "comment TextureFile my skin.png\ncomment TextureFile other.png\n";
    for (const bool seam : {false, true}) {
        const Result<bake::SourceMesh> mesh =
            bake::load_mesh(folder.write("scan.ply", meshlab_square(seam, comments)));
        ASSERT_TRUE(mesh.has_value()) << mesh.error().message;
        expect_sound(*mesh);
        EXPECT_TRUE(mesh->notes.empty());
        ASSERT_EQ(mesh->triangles.size(), 2U);
        EXPECT_EQ(mesh->positions.size(), seam ? 6U : 4U) << "only a seam splits vertices";
        const auto uv = [&](std::size_t triangle, std::size_t corner) {
            return mesh->uvs[mesh->triangles[triangle][corner]];
        };
        EXPECT_EQ(uv(0, 0), glm::vec2(0.0F, 1.0F)) << "v = 0 is the picture's top row";
        EXPECT_EQ(uv(0, 2), glm::vec2(1.0F, 0.0F));
        EXPECT_EQ(uv(1, 1), seam ? glm::vec2(0.25F, 0.75F) : glm::vec2(1.0F, 0.0F));
        EXPECT_EQ(uv(1, 2), glm::vec2(0.0F, 0.0F));
        const auto colour = [&](std::size_t triangle) {
            const bake::SourceMaterial& material = mesh->materials[mesh->triangle_materials[triangle]];
            return mesh->textures.at(static_cast<std::size_t>(material.texture)).image->at(0, 0);
        };
        EXPECT_EQ(colour(0), glm::u8vec4(10, 20, 30, 255));
        EXPECT_EQ(colour(1), glm::u8vec4(40, 50, 60, 255)) << "texnumber";
    }
}

TEST(Ply, MutatedTextureCoordinatesGiveAValidMeshOrAnError) {
    const TemporaryFolder folder;
    const auto own =
        folder.write("own.png", as_text(image::encode_png(image::Image8(1, 1, glm::u8vec4(1, 2, 3, 255)))));
    std::mt19937 random(7);
    int loaded = 0;
    for (int round = 0; round < 600; ++round) {
        std::string text = meshlab_square(round % 2 == 0, "comment TextureFile own.png\n");
        for (std::size_t changes = random() % 3 + 1; changes > 0; --changes) {
            static constexpr std::string_view marks = "0123456789 -.nae\n";
            const std::size_t data = text.find("end_header");
            text[data + random() % (text.size() - data)] = marks[random() % marks.size()];
        }
        const Result<bake::SourceMesh> mesh = bake::load_mesh(folder.write("scan.ply", text), {own});
        if (mesh) {
            expect_sound(*mesh);
            ++loaded;
        }
    }
    EXPECT_GT(loaded, 100);
}

TEST(Ply, TextureCoordinatesAtVerticesAreRead) {
    const TemporaryFolder folder;
    folder.write("skin.png", as_text(image::encode_png(image::Image8(2, 1, glm::u8vec4(10, 20, 30, 255)))));
    std::string text = replaced(square_header, "comment a square", "comment TextureFile skin.png");
    text =
        replaced(text, "property float z\n",
                 "property float z\nproperty float s\nproperty float t\nproperty uchar red\nproperty uchar "
                 "green\nproperty uchar blue\n");
    text += "0 0 0 0 0 9 9 9\n1 0 0 1 0 9 9 9\n1 1 0 1 1 9 9 9\n0 1 0 0 1 9 9 9\n4 0 1 2 3\n";
    const Result<bake::SourceMesh> mesh = bake::load_mesh(folder.write("scan.ply", text));
    ASSERT_TRUE(mesh.has_value()) << mesh.error().message;
    EXPECT_EQ(mesh->uvs[2], glm::vec2(1.0F, 0.0F));
    EXPECT_TRUE(mesh->colours.empty()) << "the picture goes before the vertices' colours";
    ASSERT_EQ(mesh->notes.size(), 1U);
    EXPECT_EQ(mesh->notes[0].kind, bake::SourceNote::Kind::Guessed);
}

TEST(Ply, ReportsLosses) {
    const std::string wedge = meshlab_square(true, "");
    const std::string faces =
        replaced(replaced(square_header, "vertex_indices", "vertex_indices\nproperty uchar red"),
                 "comment a square", "comment no picture") +
        "0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3 200\n";
    const std::string two = replaced(square_header + square_data, "4 0 1 2 3", "2 0 1\n4 0 1 2 3");
    for (const auto& [text, expected] : std::vector<std::pair<std::string, std::string>>{
             {wedge, "--texture FILE"},
             {replaced(wedge, "property int texnumber\n", "property int flags\n"), "--texture FILE"},
             {faces, "they stand at the faces"},
             {replaced(two, "face 1", "face 2"), "1 face of fewer than three corners"},
             {replaced(square_header + square_data, "comment a square", "comment TextureFile a.png"),
              "no texture coordinates"}}) {
        const Result<bake::SourceMesh> mesh = load_text("scan.ply", text);
        ASSERT_TRUE(mesh.has_value()) << mesh.error().message;
        expect_sound(*mesh);
        ASSERT_EQ(mesh->notes.size(), 1U) << expected;
        EXPECT_EQ(mesh->notes[0].kind, bake::SourceNote::Kind::Lost);
        EXPECT_NE(mesh->notes[0].text.find(expected), std::string::npos) << mesh->notes[0].text;
    }
}

TEST(Ply, TextureOptionReplacesAMissingPicture) {
    const TemporaryFolder folder;
    const auto own =
        folder.write("own.png", as_text(image::encode_png(image::Image8(1, 1, glm::u8vec4(1, 2, 3, 255)))));
    for (const std::string& comment : {std::string(), std::string("comment TextureFile gone.png\n")}) {
        std::string text = meshlab_square(true, comment);
        text = replaced(text, "6 0.5 0.5 0.25 0.25 0 1 1", "6 0.5 0.5 0.25 0.25 0 1 0");
        const auto scan = folder.write("scan.ply", text);
        const Result<bake::SourceMesh> mesh = bake::load_mesh(scan, {own});
        ASSERT_TRUE(mesh.has_value()) << mesh.error().message;
        expect_sound(*mesh);
        ASSERT_EQ(mesh->textures.size(), 1U);
        EXPECT_EQ(mesh->textures[0].image->at(0, 0), glm::u8vec4(1, 2, 3, 255));
        EXPECT_TRUE(mesh->notes.empty());
    }
    const std::string error =
        error_of(bake::load_mesh(folder.write("plain.ply", square_header + square_data), {own}));
    EXPECT_NE(error.find("[mesh.no_texture_coordinates]"), std::string::npos) << error;
}

TEST(Ply, AnElementWithoutPropertiesMayClaimAnyCount) {
    const Result<bake::SourceMesh> mesh = load_text(
        "square.ply",
        replaced(square_header, "element face", "element empty 9000000000000\nelement face") + square_data);
    EXPECT_TRUE(mesh.has_value());
}

} // namespace
} // namespace frustumscreen::testing
