#include "app/image/image.h"
#include "tests/loaders/loaders_testing.h"

#include <gtest/gtest.h>

#include <cmath>

namespace frustumscreen::testing {
namespace {

const std::string square = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

bake::SourceMesh mesh_of(const std::string& text) {
    return sound(load_text("model.obj", text));
}

TEST(Obj, NegativeIndicesCountBackFromTheLastVertex) {
    const bake::SourceMesh forward = mesh_of(square + "f 1 2 3 4\n");
    const bake::SourceMesh backward = mesh_of(square + "f -4 -3 -2 -1\n");
    EXPECT_EQ(forward.positions, backward.positions);
    EXPECT_EQ(forward.triangles, backward.triangles);
    EXPECT_NEAR(area_of(backward), 1.0, 1e-12);
}

TEST(Obj, EveryFormOfACornerIsRead) {
    const std::string extra = "vt 0.25 0.25\nvn 0 0 1\n";
    for (const char* face :
         {"f 1 2 3\n", "f 1/1 2/1 3/1\n", "f 1//1 2//1 3//1\n", "f 1/1/1 2/1/1 3/1/1\n", "f 1// 2// 3//\n",
          "f 1 2 3 # with a remark\n", "f 1 2 \\\n 3\n", "f 1 2 3\r\n"}) {
        SCOPED_TRACE(face);
        EXPECT_EQ(mesh_of(square + extra + face).triangles.size(), 1U);
    }
}

TEST(Obj, VerticesAreSplitWhereTextureCoordinatesDiffer) {
    const bake::SourceMesh mesh = mesh_of(square + "vt 0 0\nvt 1 0\nvt 1 1\nf 1/1 2/2 3/3\nf 1/2 3/3 4/1\n");
    EXPECT_EQ(mesh.positions.size(), 5U); // corner 1 twice
    EXPECT_EQ(mesh.uvs[0], glm::vec2(0.0F, 1.0F)) << "v = 0 is the picture's top row";
}

TEST(Obj, ColoursAfterTheCoordinatesAreSrgb) {
    const bake::SourceMesh mesh = mesh_of("v 0 0 0 0.5 0 1\nv 1 0 0\nv 0 1 0 1 1 1\nf 1 2 3\n");
    EXPECT_NEAR(mesh.colours[0].r, 0.2140411, 1e-6);
    EXPECT_EQ(mesh.colours[0].b, 1.0F);
    EXPECT_EQ(mesh.colours[1], glm::vec4(1.0F));
}

TEST(Obj, CoordinatesKeepSixtyFourBits) {
    const bake::SourceMesh mesh = mesh_of("v 4500000.125 0 0\nv 4500001.25 0 0\nv 4500000 1 0\nf 1 2 3\n");
    EXPECT_EQ(mesh.positions[0].x, 4500000.125);
    EXPECT_EQ(mesh.positions[1].x, 4500001.25);
}

TEST(Obj, APolygonMayHaveMoreThan255Corners) {
    std::string text;
    std::string face = "f";
    for (int i = 0; i < 300; ++i) {
        const double angle = i * std::acos(-1.0) / 150.0;
        text += "v " + std::to_string(std::cos(angle)) + " " + std::to_string(std::sin(angle)) + " 0\n";
        face += " " + std::to_string(i + 1);
    }
    EXPECT_EQ(mesh_of(text + face + "\n").triangles.size(), 298U);
}

/// The note about losses of a mesh with exactly one note.
std::string lost_of(const bake::SourceMesh& mesh) {
    EXPECT_EQ(mesh.notes.size(), 1U);
    if (mesh.notes.empty()) {
        return {};
    }
    EXPECT_EQ(mesh.notes[0].kind, bake::SourceNote::Kind::Lost);
    return mesh.notes[0].text;
}

TEST(Obj, MissingMaterialFileGivesWhiteAndIsReported) {
    const bake::SourceMesh mesh = mesh_of("mtllib nowhere.mtl\n" + square + "usemtl gold\nf 1 2 3\n");
    EXPECT_EQ(mesh.materials[mesh.triangle_materials[0]].base_colour, glm::vec4(1.0F));
    EXPECT_NE(lost_of(mesh).find("the colours: it names \"nowhere.mtl\" for them"), std::string::npos);
}

TEST(Obj, ReportsLosses) {
    EXPECT_TRUE(mesh_of(square + "f 1 2 3\n").notes.empty());
    EXPECT_NE(lost_of(mesh_of(square + "usemtl gold\nf 1 2 3\n")).find("no file of materials"),
              std::string::npos);
    EXPECT_EQ(lost_of(mesh_of(square + "f 1 2 3\nf 1 2\nf 1\n")), "2 faces of fewer than three corners");
    EXPECT_NE(lost_of(mesh_of(square + "f 1 2 3\nl 1 2\np 1\n")).find("2 parts that no triangle"),
              std::string::npos);
    const TemporaryFolder folder;
    folder.write("model.mtl", "newmtl red\nKd 1 0 0\n");
    const Result<bake::SourceMesh> mesh =
        bake::load_mesh(folder.write("model.obj", "mtllib model.mtl\n" + square + "usemtl gold\nf 1 2 3\n"));
    ASSERT_TRUE(mesh.has_value()) << mesh.error().message;
    EXPECT_NE(lost_of(*mesh).find("material \"gold\""), std::string::npos);
}

TEST(Obj, FindsFilesByForeignPaths) {
    const std::string text = square + "vt 0 0\nusemtl wood\nf 1/1 2/1 3/1\n";
    for (const char* map :
         {"WOOD.PNG", "C:\\scans\\Wood.png", "C:/scans/wood.png", "/home/someone/wood.png", "..\\wood.png",
          "Maps/wood.png", "maps\\WOOD.png", "file:///C:/wood.png", "./wood.PNG"}) {
        SCOPED_TRACE(map);
        const TemporaryFolder folder;
        const std::string png(as_text(image::encode_png(image::Image8(1, 1, glm::u8vec4(10, 20, 30, 255)))));
        folder.write("wood.png", png);
        folder.write("maps/wood.png", png);
        folder.write("Model.mtl", std::string("newmtl wood\nmap_Kd ") + map + "\n");
        const Result<bake::SourceMesh> mesh =
            bake::load_mesh(folder.write("model.obj", "mtllib D:\\model.MTL\n" + text));
        ASSERT_TRUE(mesh.has_value()) << mesh.error().message;
        ASSERT_EQ(mesh->textures.size(), 1U);
        ASSERT_FALSE(mesh->notes.empty());
        EXPECT_EQ(mesh->notes[0].kind, bake::SourceNote::Kind::Guessed);
        EXPECT_NE(mesh->notes[0].text.find("Model.mtl beside it is used"), std::string::npos);
    }
}

/// Faces in the tiles 1001, 1002 and 1011, each a triangle with a vertex of its own on the tile's edge.
const std::string three_tiles = square + "vt 0.1 0.1\nvt 1 0.1\nvt 0.1 0.9\n"
                                         "vt 1.1 0.1\nvt 1.9 0.1\nvt 1 0.9\n"
                                         "vt 0.1 1.1\nvt 0.9 1\nvt 0.1 1.9\n"
                                         "usemtl wood\nf 1/1 2/2 3/3\nf 1/4 2/5 3/6\nf 1/7 2/8 3/9\n";

std::string plain_png(std::uint8_t red) {
    return std::string(as_text(image::encode_png(image::Image8(2, 2, glm::u8vec4(red, 0, 0, 255)))));
}

TEST(Obj, ReadsUdimTiles) {
    for (const char* map : {"skin.<UDIM>.png", "skin.1001.png"}) {
        SCOPED_TRACE(map);
        const TemporaryFolder folder;
        for (const auto& [tile, red] : {std::pair(1001, 10), {1002, 20}, {1011, 30}}) {
            folder.write(fmt::format("skin.{}.png", tile), plain_png(static_cast<std::uint8_t>(red)));
        }
        folder.write("model.mtl", std::string("newmtl wood\nmap_Kd ") + map + "\n");
        const Result<bake::SourceMesh> mesh =
            bake::load_mesh(folder.write("model.obj", "mtllib model.mtl\n" + three_tiles));
        ASSERT_TRUE(mesh) << mesh.error().message;
        ASSERT_EQ(mesh->triangle_materials.size(), 3U);
        for (std::size_t t = 0; t < 3; ++t) {
            const bake::SourceMaterial& material = mesh->materials[mesh->triangle_materials[t]];
            ASSERT_GE(material.texture, 0);
            const image::Image8& picture = *mesh->textures[static_cast<std::size_t>(material.texture)].image;
            EXPECT_EQ(picture.at(0, 0).r, 10 * (t + 1));
        }
        EXPECT_EQ(mesh->side_files.size(), 4U);
    }
}

TEST(Obj, RepeatsASinglePictureWithATileNumber) {
    const TemporaryFolder folder;
    folder.write("skin.1001.png", plain_png(10));
    folder.write("model.mtl", "newmtl wood\nmap_Kd skin.1001.png\n");
    const Result<bake::SourceMesh> mesh =
        bake::load_mesh(folder.write("model.obj", "mtllib model.mtl\n" + three_tiles));
    ASSERT_TRUE(mesh) << mesh.error().message;
    for (const std::uint32_t number : mesh->triangle_materials) {
        const auto texture = static_cast<std::size_t>(mesh->materials[number].texture);
        EXPECT_EQ(mesh->textures[texture].image->at(0, 0).r, 10);
    }
}

TEST(Obj, ATileWithoutItsPictureIsRefused) {
    const TemporaryFolder folder;
    folder.write("skin.1001.png", plain_png(10));
    folder.write("model.mtl", "newmtl wood\nmap_Kd skin.<UDIM>.png\n");
    const std::string error =
        error_of(bake::load_mesh(folder.write("model.obj", "mtllib model.mtl\n" + three_tiles)));
    EXPECT_NE(error.find("skin.1002.png"), std::string::npos) << error;
}

TEST(Obj, PicturesAreShrunkUntilAllOfThemFit) {
    const TemporaryFolder folder;
    const std::array<int, 3> sides{64, 64, 16};
    std::string materials;
    std::string text = "mtllib model.mtl\n" + square + "vt 0 0\nvt 1 0\nvt 0 1\n";
    for (std::size_t k = 0; k < sides.size(); ++k) {
        const auto code = static_cast<std::uint8_t>(50 * k);
        folder.write(
            fmt::format("{}.png", k),
            as_text(image::encode_png(image::Image8(sides[k], sides[k], glm::u8vec4(code, 200, 100, 255)))));
        materials += fmt::format("newmtl m{0}\nmap_Kd {0}.png\n", k);
        text += fmt::format("usemtl m{}\nf 1/1 2/2 3/3\n", k);
    }
    folder.write("model.mtl", materials);
    const auto model = folder.write("model.obj", text);
    const Result<bake::SourceMesh> whole = bake::load_mesh(model);
    ASSERT_TRUE(whole) << whole.error().message;
    EXPECT_TRUE(whole->notes.empty());
    bake::LoadOptions options;
    options.kept_texels = 64 * 64;
    const Result<bake::SourceMesh> shrunk = bake::load_mesh(model, options);
    ASSERT_TRUE(shrunk) << shrunk.error().message;
    ASSERT_EQ(shrunk->textures.size(), 3U);
    for (std::size_t k = 0; k < sides.size(); ++k) {
        const image::Image8& picture = *shrunk->textures[k].image;
        EXPECT_EQ(picture.width, std::min(sides[k], 32)) << "the two large ones alike";
        EXPECT_EQ(picture.at(0, 0), whole->textures[k].image->at(0, 0));
        EXPECT_EQ(shrunk->contents.picture_sizes[k], glm::ivec2(sides[k]));
    }
    ASSERT_EQ(shrunk->notes.size(), 1U);
    EXPECT_EQ(shrunk->notes[0].kind, bake::SourceNote::Kind::Guessed)
        << "nothing is lost that a pack could show";
    EXPECT_TRUE(shrunk->notes[0].text.starts_with("2 of its 3 pictures are shrunk")) << shrunk->notes[0].text;
}

TEST(Obj, TextureOptionReplacesOnlyAMissingPicture) {
    const TemporaryFolder folder;
    const std::string text = "mtllib model.mtl\n" + square + "vt 0 0\nusemtl wood\nf 1/1 2/1 3/1\n";
    const auto own =
        folder.write("own.png", as_text(image::encode_png(image::Image8(1, 1, glm::u8vec4(1, 2, 3, 255)))));
    const auto model = folder.write("model.obj", text);
    const auto texel = [](const Result<bake::SourceMesh>& mesh) {
        EXPECT_TRUE(mesh.has_value()) << mesh.error().message;
        return mesh && mesh->textures.size() == 1 ? mesh->textures[0].image->at(0, 0) : glm::u8vec4(0);
    };
    EXPECT_EQ(texel(bake::load_mesh(model, {own})), glm::u8vec4(1, 2, 3, 255)) << "without the .mtl";
    folder.write("model.mtl", "newmtl wood\nmap_Kd gone.png\n");
    EXPECT_EQ(texel(bake::load_mesh(model, {own})), glm::u8vec4(1, 2, 3, 255));
    folder.write("gone.png", as_text(image::encode_png(image::Image8(1, 1, glm::u8vec4(9, 9, 9, 255)))));
    const Result<bake::SourceMesh> whole = bake::load_mesh(model, {own});
    EXPECT_EQ(texel(whole), glm::u8vec4(9, 9, 9, 255)) << "the model's own goes first";
    ASSERT_EQ(whole->notes.size(), 1U);
    EXPECT_EQ(whole->notes[0].kind, bake::SourceNote::Kind::Guessed);
    EXPECT_NE(
        error_of(bake::load_mesh(folder.write("plain.obj", square + "f 1 2 3\n"), {own})).find("--texture"),
        std::string::npos);
    EXPECT_NE(error_of(bake::load_mesh(folder.write("plain.obj", text), {folder.path() / "none.png"}))
                  .find("none.png"),
              std::string::npos);
}

TEST(Obj, ReadsColourAndPictureOfMaterials) {
    const TemporaryFolder folder;
    image::Image8 picture(2, 1, glm::u8vec4(10, 20, 30, 255));
    const Bytes png = image::encode_png(picture);
    folder.write("maps/my wood.png", as_text(png));
    folder.write("model.mtl", "newmtl red\nKd 1 0.5 0\nnewmtl wood\nKd 1 1 1\nmap_Kd maps\\my wood.png\n");
    const Result<bake::SourceMesh> mesh = bake::load_mesh(
        folder.write("model.obj", "mtllib model.mtl\n" + square +
                                      "vt 0 0\nusemtl red\nf 1 2 3\nusemtl wood\nf 1/1 3/1 4/1\n"));
    ASSERT_TRUE(mesh.has_value()) << mesh.error().message;
    expect_sound(*mesh);
    EXPECT_EQ(mesh->materials[mesh->triangle_materials[0]].base_colour, glm::vec4(1.0F, 0.5F, 0.0F, 1.0F));
    const bake::SourceMaterial& wood = mesh->materials[mesh->triangle_materials[1]];
    ASSERT_EQ(wood.texture, 0);
    EXPECT_EQ(mesh->textures[0].image->at(1, 0), glm::u8vec4(10, 20, 30, 255));
}

TEST(Obj, RejectsMissingDamagedOrOutsidePictures) {
    const std::string text = "mtllib model.mtl\n" + square + "usemtl wood\nf 1 2 3\n";
    for (const auto& [map, expected] : std::vector<std::pair<std::string, std::string>>{
             {"gone.png",
              "its picture \"gone.png\" is not beside it; put it there, or name another picture with "
              "--texture FILE (map_Kd gone.png)"},
             {"BAD.jpg", "--texture FILE, such as bad.png ("},
             {"bad.png", "PNG picture is damaged"},
             {"model.mtl", "neither PNG"},
             {"../outside.png", "\"outside.png\" is not beside it"},
             {"maps/../../outside.png", "\"outside.png\" is not beside it"},
             {"/etc/hostname", "\"hostname\" is not beside it"},
             {"C:\\pictures\\wood.png", "\"wood.png\" is not beside it"},
             {"http://example.org/wood.png", "\"wood.png\" is not beside it"}}) {
        const TemporaryFolder folder;
        folder.write("bad.png", "\x89PNG\r\n\x1a\n and nothing more");
        folder.write("model.mtl", "newmtl wood\nmap_Kd " + map + "\n");
        const std::string error = error_of(bake::load_mesh(folder.write("model.obj", text)));
        EXPECT_NE(error.find(expected), std::string::npos) << error;
    }
}

TEST(Obj, ErrorsNameTheLine) {
    for (const auto& [line, expected] : std::vector<std::pair<std::string, std::string>>{
             {"f 1 2 5", "line 5: vertex 5 is out of range"},
             {"f 0 1 2", "line 5: vertex 0 is out of range"},
             {"f -5 1 2", "line 5: vertex -5 is out of range"},
             {"f 1 2 x", "line 5: the number of a vertex is expected"},
             {"f 1 2 99999999999999999999", "line 5"},
             {"f 1/1 2/1 3/1", "line 5: texture coordinate 1 is out of range"},
             {"v 1 2", "line 5: 3 numbers are expected"},
             {"v 1 2 three", "line 5: a number is expected, not \"three\""},
             {"v 1 2 nan", "line 5: vertex 5 is not a finite point"},
             {"v 1 2 1e999", "line 5: vertex 5 is not a finite point"},
             {"f 1 2", "[mesh.point_cloud]"},
             {"p 1\nl 1 2", "[mesh.point_cloud]"}}) {
        const std::string error = error_of(load_text("model.obj", square + line + "\n"));
        EXPECT_NE(error.find(expected), std::string::npos) << error;
    }
}

} // namespace
} // namespace frustumscreen::testing
