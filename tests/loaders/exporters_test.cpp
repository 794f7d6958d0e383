// Files as exporters write them; users reported a wrong picture for each.
#include "app/image/image.h"
#include "tests/loaders/loaders_testing.h"
#include "tests/loaders/sample_pictures.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <bit>

namespace frustumscreen::testing {
namespace {

const std::string triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\n";
const std::string textured_face = "f 1/1 2/1 3/1\n";
const glm::u8vec4 wood_code(10, 20, 30, 255);

/// An OBJ with a .mtl, and a picture wood.png of one texel.
bake::SourceMesh obj_with(std::string_view mtl, const std::string& rest,
                          const std::string& first = "mtllib model.mtl\n") {
    const TemporaryFolder folder;
    folder.write("model.mtl", mtl);
    folder.write("wood.png", png_of(image::Image8(1, 1, wood_code)));
    return sound(bake::load_mesh(folder.write("model.obj", first + triangle + rest)));
}

glm::vec4 base_colour(const bake::SourceMesh& mesh) {
    return mesh.triangle_materials.empty() ? glm::vec4(-1.0F)
                                           : mesh.materials[mesh.triangle_materials[0]].base_colour;
}

bool shows_wood(const bake::SourceMesh& mesh) {
    return mesh.textures.size() == 1 && mesh.textures[0].image->at(0, 0) == wood_code &&
           base_colour(mesh) == glm::vec4(1.0F);
}

TEST(Exporters, AMaterialWithoutKdIsWhite) {
    for (const char* mtl : {"newmtl m\nNs 10\nillum 2\n", "newmtl m\n", "newmtl m\nKd 1 1 1\n"}) {
        const bake::SourceMesh mesh = obj_with(mtl, "usemtl m\nf 1 2 3\n");
        EXPECT_EQ(base_colour(mesh), glm::vec4(1.0F)) << mtl;
        EXPECT_TRUE(mesh.notes.empty()) << mtl;
    }
    EXPECT_TRUE(shows_wood(obj_with("newmtl m\nmap_Kd wood.png\n", "usemtl m\n" + textured_face)));
    EXPECT_EQ(base_colour(obj_with("newmtl m\nKd 0 0 0\n", "usemtl m\nf 1 2 3\n")), glm::vec4(0, 0, 0, 1))
        << "black that is written stays";
    EXPECT_EQ(base_colour(obj_with("newmtl m\nKd 0.5\n", "usemtl m\nf 1 2 3\n")),
              glm::vec4(0.5F, 0.5F, 0.5F, 1))
        << "one number is grey";
}

TEST(Exporters, KeywordsOfMaterialsMayHaveAnyCaseAndAByteOrderMark) {
    for (const std::string mtl : {"newmtl m\nmap_KD wood.png\n", "NEWMTL m\nMAP_KD wood.png\nKD 1 1 1\n",
                                  "\xEF\xBB\xBFnewmtl m\nmap_kd wood.png\n",
                                  "\tnewmtl m\r\n\tmap_Kd wood.png\r\n", "newmtl m\rmap_Kd wood.png\r"}) {
        EXPECT_TRUE(shows_wood(obj_with(mtl, "usemtl m\n" + textured_face))) << mtl;
    }
}

TEST(Exporters, ReportsUnknownMtlKeywords) {
    const bake::SourceMesh mesh = obj_with("newmtl m\nmap_Kdd wood.png\nglitter 3\n", "usemtl m\nf 1 2 3\n");
    EXPECT_TRUE(notes(mesh, bake::SourceNote::Kind::Lost, "glitter, map_Kdd"));
}

TEST(Exporters, ReportsMtlKeywordsThatAffectThePicture) {
    const bake::SourceMesh plain = obj_with("newmtl m\n", "usemtl m\n" + textured_face);
    for (const std::string keyword : {"Ks 1 1 1", "Ka 1 0 0", "Ns 9", "Ni 1.5", "illum 2", "Pr 0.5",
                                      "map_Pr wood.png", "map_Ks wood.png", "refl wood.png", "sharpness 9"}) {
        const bake::SourceMesh mesh = obj_with("newmtl m\n" + keyword + "\n", "usemtl m\n" + textured_face);
        EXPECT_TRUE(mesh.notes.empty()) << keyword;
    }
    for (const std::string keyword :
         {"map_d wood.png", "map_opacity wood.png", "map_Tr wood.png", "decal wood.png", "d 0.5", "Tr 0.5",
          "bump wood.png", "norm wood.png", "map_norm wood.png", "disp wood.png", "map_Kd -mm 0.2 1 wood.png",
          "map_Kd -t 1 1 1 wood.png", "map_Kd -o 0.5 0 0 wood.png", "glitter 1"}) {
        const bake::SourceMesh mesh = obj_with("newmtl m\n" + keyword + "\n", "usemtl m\n" + textured_face);
        EXPECT_TRUE(notes(mesh, bake::SourceNote::Kind::Lost, "")) << keyword;
    }
    EXPECT_TRUE(plain.notes.empty());
}

TEST(Exporters, ObjWithoutUsemtlUsesTheOnlyMaterial) {
    const bake::SourceMesh mesh = obj_with("newmtl m\nmap_Kd wood.png\n", textured_face);
    EXPECT_TRUE(shows_wood(mesh));
    EXPECT_TRUE(notes(mesh, bake::SourceNote::Kind::Guessed, "\"m\""));
    const bake::SourceMesh two = obj_with("newmtl m\nKd 1 0 0\nnewmtl n\nKd 0 1 0\n", "f 1 2 3\n");
    EXPECT_TRUE(notes(two, bake::SourceNote::Kind::Lost, "has 2")) << "which of two is not known";
}

TEST(Exporters, MtllibMayNameSeveralFilesWithBlanks) {
    const TemporaryFolder folder;
    folder.write("a.mtl", "newmtl red\nKd 1 0 0\n");
    folder.write("my own.mtl", "newmtl blue\nKd 0 0 1\n");
    const auto colours = [&](const std::string& line) {
        const bake::SourceMesh mesh = sound(bake::load_mesh(folder.write(
            "model.obj", line + "\n" + triangle + "usemtl red\nf 1 2 3\nusemtl blue\nf 1 2 3\n")));
        EXPECT_TRUE(mesh.notes.empty()) << line;
        return std::pair(mesh.materials[0].base_colour, mesh.materials[1].base_colour);
    };
    const std::pair expected(glm::vec4(1, 0, 0, 1), glm::vec4(0, 0, 1, 1));
    EXPECT_EQ(colours("mtllib a.mtl my own.mtl"), expected);
    EXPECT_EQ(colours("mtllib my own.mtl a.mtl"), expected);
    EXPECT_EQ(colours("mtllib a.mtl\nmtllib my own.mtl"), expected);
    const bake::SourceMesh half = sound(bake::load_mesh(
        folder.write("model.obj", "mtllib a.mtl none.mtl\n" + triangle + "usemtl red\nf 1 2 3\n")));
    EXPECT_TRUE(notes(half, bake::SourceNote::Kind::Lost, "\"none.mtl\""));
    EXPECT_EQ(half.materials[0].base_colour, expected.first);
}

TEST(Exporters, FindsAPictureBesideItsMtl) {
    const TemporaryFolder folder;
    folder.write("materials/model.mtl", "newmtl m\nmap_Kd wood.png\n");
    folder.write("materials/wood.png", png_of(image::Image8(1, 1, wood_code)));
    const bake::SourceMesh mesh = sound(bake::load_mesh(
        folder.write("model.obj", "mtllib materials/model.mtl\n" + triangle + "usemtl m\n" + textured_face)));
    EXPECT_TRUE(shows_wood(mesh));
    EXPECT_TRUE(mesh.notes.empty());
}

TEST(Exporters, MatchesFileNamesAcrossNormalizationCaseAndCodePage) {
    // "Büste Grün.png": composed, decomposed, in capitals, in Windows-1252.
    const std::string composed = "B\xC3\xBCste Gr\xC3\xBCn.png";
    const std::string decomposed = "Bu\xCC\x88ste Gru\xCC\x88n.png";
    for (const std::string& on_disk : {composed, decomposed}) {
        for (const std::string& named : {composed, decomposed, std::string("B\xC3\x9CSTE GR\xC3\x9CN.PNG"),
                                         std::string("B\xFCste Gr\xFCn.png")}) {
            const TemporaryFolder folder;
            folder.write(on_disk, png_of(image::Image8(1, 1, wood_code)));
            folder.write("model.mtl", "newmtl m\nmap_Kd " + named + "\n");
            EXPECT_TRUE(shows_wood(sound(bake::load_mesh(
                folder.write("model.obj", "mtllib model.mtl\n" + triangle + "usemtl m\n" + textured_face)))))
                << on_disk << " " << named;
        }
    }
}

TEST(Exporters, ColoursAboveOneAreCodesTo255InTheWholeFile) {
    const bake::SourceMesh codes =
        sound(load_text("model.obj", "v 0 0 0 188 0 1\nv 1 0 0 1 0 0\nv 0 1 0 255 255 255\nf 1 2 3\n"));
    const bake::SourceMesh shares = sound(
        load_text("model.obj", fmt::format("v 0 0 0 {0} 0 {1}\nv 1 0 0 {1} 0 0\nv 0 1 0 1 1 1\nf 1 2 3\n",
                                           188.0 / 255, 1.0 / 255)));
    for (std::size_t k = 0; k < 3; ++k) {
        for (int i = 0; i < 3; ++i) {
            EXPECT_NEAR(codes.colours[k][i], shares.colours[k][i], 1e-6);
        }
    }
    EXPECT_NEAR(codes.colours[0].r, 0.5028865, 1e-5) << "sRGB of 188";
    EXPECT_TRUE(notes(codes, bake::SourceNote::Kind::Guessed, "0 to 255"));
    EXPECT_TRUE(shares.notes.empty());
    const bake::SourceMesh over =
        sound(load_text("model.obj", "v 0 0 0 1.002 0 0\nv 1 0 0 0.5 0 0\nv 0 1 0 1 1 1\nf 1 2 3\n"));
    EXPECT_EQ(over.colours[0].r, 1.0F) << "a rounding above 1 makes no codes";
    EXPECT_EQ(base_colour(obj_with("newmtl m\nKd 255 51 0\n", "usemtl m\nf 1 2 3\n")),
              glm::vec4(1.0F, 0.2F, 0.0F, 1.0F));
}

// Wavefront's Appendix B1 (Object Files, 3.0): "v x y z w", where w is 1 by default; "vt u v w", where w is the depth of a
// texture of three dimensions. "v x y z r g b" and "v x y z r g b a" are written by many programs.
TEST(Exporters, ReportsExtraVertexNumbersThatCouldChangeThePicture) {
    const auto with = [](const std::string& vertex, const std::string& uv) {
        return sound(load_text("model.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0" + vertex + "\nvt 0.5 0.5" + uv +
                                                "\nf 1/1 2/1 3/1\n"));
    };
    for (const char* vertex :
         {"", " 1", " 1.0", " 0.2 0.4 0.6", " 0.2 0.4 0.6 1", " 200 100 50 255", " 1 # w"}) {
        const bake::SourceMesh mesh = with(vertex, "");
        EXPECT_FALSE(notes(mesh, bake::SourceNote::Kind::Lost, "")) << vertex;
    }
    for (const char* vertex : {" 2", " 0", " 0.2 0.4", " 0.2 0.4 0.6 0.5", " 0.2 0.4 0.6 1 7"}) {
        const bake::SourceMesh mesh = with(vertex, "");
        EXPECT_TRUE(notes(mesh, bake::SourceNote::Kind::Lost, "after x y z of 1 vertex, first in line 3"))
            << vertex;
        EXPECT_EQ(mesh.positions[2], glm::dvec3(0, 1, 0)) << vertex;
    }
    for (const char* uv : {"", " 0", " 0.9995"}) {
        EXPECT_TRUE(with("", uv).notes.empty()) << uv;
    }
    EXPECT_TRUE(notes(with("", " 0 7"), bake::SourceNote::Kind::Lost,
                      "after u v w of 1 texture coordinate, first in line 4"));
}

TEST(Exporters, TextureCoordinateIndexZeroIsDroppedAndReported) {
    const bake::SourceMesh mesh = obj_with("newmtl m\nKd 1 0 0\n", "usemtl m\nf 1/0 2/0 3/0\n");
    EXPECT_EQ(mesh.triangles.size(), 1U);
    EXPECT_TRUE(notes(mesh, bake::SourceNote::Kind::Lost, "3 corners"));
}

TEST(Exporters, EmissionReplacesAMissingColour) {
    const bake::SourceMesh picture =
        obj_with("newmtl m\nKd 0 0 0\nmap_Ke wood.png\n", "usemtl m\n" + textured_face);
    EXPECT_TRUE(shows_wood(picture));
    EXPECT_TRUE(notes(picture, bake::SourceNote::Kind::Guessed, "own light"));
    EXPECT_EQ(base_colour(obj_with("newmtl m\nKd 0 0 0\nKe 0.5 0.25 1\n", "usemtl m\nf 1 2 3\n")),
              glm::vec4(0.5F, 0.25F, 1.0F, 1.0F));
    const bake::SourceMesh both =
        obj_with("newmtl m\nmap_Kd wood.png\nmap_Ke wood.png\n", "usemtl m\n" + textured_face);
    EXPECT_TRUE(shows_wood(both));
    EXPECT_TRUE(notes(both, bake::SourceNote::Kind::Lost, "own light of the material"));
}

TEST(Exporters, ReportsMaterialFeaturesThatAreNotShown) {
    for (const auto& [line, words] :
         std::vector<std::pair<std::string, std::string>>{{"bump wood.png", "relief"},
                                                          {"norm wood.png", "relief"},
                                                          {"disp wood.png", "relief"},
                                                          {"map_Bump -bm 0.2 wood.png", "relief"},
                                                          {"map_d wood.png", "cut-outs"},
                                                          {"d 0.5", "transparency"},
                                                          {"Tr 0.5", "transparency"},
                                                          {"map_Kd -s 2 2 wood.png", "-o, -s"}}) {
        EXPECT_TRUE(notes(obj_with("newmtl m\nKd 1 1 1\n" + line + "\n", "usemtl m\n" + textured_face),
                          bake::SourceNote::Kind::Lost, words))
            << line;
    }
    EXPECT_TRUE(
        obj_with("newmtl m\nKd 1 1 1\nd 1\nKs 1 1 1\nmap_Ks wood.png\nPr 0.5\n", "usemtl m\n" + textured_face)
            .notes.empty())
        << "shine changes no colour";
}

TEST(Exporters, ReportsUnknownObjLines) {
    EXPECT_TRUE(notes(sound(load_text("model.obj", triangle + "f 1 2 3\nfoo 1\n")),
                      bake::SourceNote::Kind::Lost, "foo"));
    EXPECT_TRUE(
        sound(load_text("model.obj", "o a\ng b\ns 1\nvn 0 0 1\n" + triangle + "f 1 2 3\n")).notes.empty());
}

std::string ply(std::string_view properties, std::string_view row, std::string_view index = "uchar int") {
    return fmt::format(
        "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n{}"
        "element face 1\nproperty list {} vertex_indices\nend_header\n0 0 0 {}\n1 0 0 {}\n0 1 0 {}\n3 0 1 "
        "2\n",
        properties, index, row, row, row);
}

std::string colours(std::string_view type, std::string_view red, std::string_view green,
                    std::string_view blue) {
    return fmt::format("property {0} {1}\nproperty {0} {2}\nproperty {0} {3}\n", type, red, green, blue);
}

TEST(Exporters, PlyColoursHaveManyNames) {
    for (const auto& [red, green, blue] :
         std::vector<std::array<const char*, 3>>{{"red", "green", "blue"},
                                                 {"r", "g", "b"},
                                                 {"Red", "Green", "Blue"},
                                                 {"diffuse_red", "diffuse_green", "diffuse_blue"},
                                                 {"R", "G", "B"},
                                                 {"diffuse_r", "diffuse_g", "diffuse_b"}}) {
        const bake::SourceMesh mesh =
            sound(load_text("model.ply", ply(colours("uchar", red, green, blue), "188 0 255")));
        ASSERT_EQ(mesh.colours.size(), 3U) << red;
        EXPECT_NEAR(mesh.colours[0].r, 0.5028865, 1e-5) << red;
        EXPECT_EQ(mesh.colours[0].g, 0.0F);
        EXPECT_EQ(mesh.colours[0].b, 1.0F);
        EXPECT_TRUE(mesh.notes.empty()) << red;
    }
}

TEST(Exporters, PlainPlyColourTakesPrecedenceOverDiffuse) {
    const bake::SourceMesh mesh =
        sound(load_text("model.ply", ply(colours("uchar", "diffuse_red", "diffuse_green", "diffuse_blue") +
                                             colours("uchar", "red", "green", "blue"),
                                         "0 0 0 255 255 255")));
    EXPECT_EQ(mesh.colours[0], glm::vec4(1.0F));
}

TEST(Exporters, PlyColoursAsFloatsMayBeCodes) {
    const bake::SourceMesh codes =
        sound(load_text("model.ply", ply(colours("float", "red", "green", "blue"), "188 0 255")));
    EXPECT_NEAR(codes.colours[0].r, 0.5028865, 1e-5);
    EXPECT_TRUE(notes(codes, bake::SourceNote::Kind::Guessed, "0 to 255"));
    EXPECT_NEAR(
        sound(load_text("model.ply", ply(colours("float", "red", "green", "blue"), "0.5 0 1"))).colours[0].r,
        0.2140411, 1e-5);
}

TEST(Exporters, PlyColoursMayBePackedIntoOneNumber) {
    const bake::SourceMesh whole =
        sound(load_text("model.ply", ply("property uint rgb\n", fmt::format("{}", (188U << 16U) | 255U))));
    ASSERT_EQ(whole.colours.size(), 3U);
    EXPECT_NEAR(whole.colours[0].r, 0.5028865, 1e-5);
    EXPECT_EQ(whole.colours[0].b, 1.0F);
    const bake::SourceMesh packed = sound(
        load_text("model.ply", ply("property float rgb\n",
                                   fmt::format("{:.17g}", std::bit_cast<float>((188U << 16U) | 255U)))));
    EXPECT_NEAR(packed.colours[0].r, 0.5028865, 1e-5);
}

TEST(Exporters, PlyWholeNumbersMayHave64Bits) {
    for (const char* index : {"uchar int64", "uchar uint64", "int64 int64", "int uint"}) {
        EXPECT_EQ(sound(load_text("model.ply", ply("", "", index))).triangles.size(), 1U) << index;
    }
    EXPECT_TRUE(sound(load_text("model.ply", ply("property int64 id\n", "7"))).notes.empty());
    EXPECT_EQ(sound(load_text("model.ply", "\xEF\xBB\xBF" + ply("", ""))).triangles.size(), 1U)
        << "a byte order mark";
}

TEST(Exporters, ReportsUnusedPlyProperties) {
    EXPECT_TRUE(notes(sound(load_text("model.ply", ply("property float shininess\n", "1"))),
                      bake::SourceNote::Kind::Lost, "shininess"));
    EXPECT_TRUE(notes(sound(load_text("model.ply", ply("property uchar red\n", "1"))),
                      bake::SourceNote::Kind::Lost, "not all there"));
    EXPECT_TRUE(sound(load_text("model.ply",
                                ply("property float nx\nproperty float quality\nproperty float scalar_C2C\n",
                                    "0 0 0")))
                    .notes.empty());
}

} // namespace
} // namespace frustumscreen::testing
