// A file's metadata, and the notes on parts of a glTF file that are not shown.
#include "assets_baked/bake/loaders/source_about.h"
#include "tests/loaders/loaders_testing.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace frustumscreen::testing {
namespace {

bake::SourceAbout about_of(const std::string& asset) {
    return bake::about_of_gltf(nlohmann::json::parse(fmt::format(R"({{"asset":{}}})", asset)));
}

TEST(SourceAbout, reads_Sketchfab_extras_or_copyright_of_glTF) {
    EXPECT_EQ(
        about_of(
            R"json({"extras":{"author":"Ann (https://a.org/ann)","title":"A  cat\n","license":"CC-BY-4.0 (http://b.org)","source":"https://a.org/cat"}})json"),
        (bake::SourceAbout{"A cat", "Ann (https://a.org/ann)", "CC-BY-4.0 (http://b.org)",
                           "https://a.org/cat"}));
    EXPECT_EQ(about_of(R"({"copyright":"2018 (c) Ann, CC-BY 4.0"})"),
              (bake::SourceAbout{"", "2018 (c) Ann, CC-BY 4.0", "CC-BY 4.0", ""}));
    EXPECT_EQ(about_of(R"({"copyright":"CC0 - public domain"})").licence, "CC0");
    EXPECT_EQ(about_of(R"({"copyright":"Ann","extras":{"author":"Bo","license":"CC0-1.0"}})"),
              (bake::SourceAbout{"", "Bo", "CC0-1.0", ""}));
    for (const char* strange :
         {R"({"copyright":5,"extras":[]})", R"({"extras":{"author":{},"license":null}})", "7"}) {
        EXPECT_EQ(about_of(strange), bake::SourceAbout()) << strange;
    }
    const std::string long_name = std::string(999, 'a') + "\u00E4\u00E4";
    EXPECT_EQ(about_of(fmt::format(R"({{"extras":{{"author":"{}"}}}})", long_name)).author,
              std::string(999, 'a'));
}

TEST(SourceAbout, takes_the_first_comment_of_each_kind) {
    bake::SourceAbout about;
    bake::take_comments(
        "# Title: Jar\r\n  ## AUTHOR : Ann\n#license:CC0-1.0\n# Licence: other\n#Source: https://a.org\n"
        "newmtl Title: no\n# Blender MTL File: 'None'\n# Material Count: 1\n# Created by: a program\n",
        about);
    EXPECT_EQ(about, (bake::SourceAbout{"Jar", "Ann", "CC0-1.0", "https://a.org"}));
    about = {};
    bake::take_comment("Copyright (c) 2020 Ann, CC BY-SA 3.0", about);
    EXPECT_EQ(about, (bake::SourceAbout{"", "Copyright (c) 2020 Ann, CC BY-SA 3.0", "CC BY-SA 3.0", ""}));
    bake::take_comments("", about);
    bake::take_comments("#", about);
}

TEST(SourceAbout, is_read_from_obj_mtl_and_ply_comments) {
    const TemporaryFolder folder;
    folder.write("m.mtl", "# License: CC0-1.0\nnewmtl a\nKd 1 0 0\n");
    const std::string square = "v 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl a\nf 1 2 3\n";
    EXPECT_EQ(bake::load_mesh(folder.write("m.obj", "# Author: Ann\nmtllib m.mtl\n" + square))->about,
              (bake::SourceAbout{"", "Ann", "CC0-1.0", ""}));
    const std::string ply =
        "ply\nformat ascii 1.0\ncomment Author: Bo\nobj_info title: Jar\nelement vertex 3\n"
        "property float x\nproperty float y\nproperty float z\nelement face 1\n"
        "property list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
    EXPECT_EQ(load_text("m.ply", ply)->about, (bake::SourceAbout{"Jar", "Bo", "", ""}));
}

/// The notes on a triangle with this material and these members of the file.
std::vector<std::string> lost_of(const std::string& material, const std::string& members = "",
                                 const std::string& primitive = "") {
    const std::string bytes = bytes_of(std::vector<float>{0, 0, 0, 1, 0, 0, 0, 1, 0});
    const Result<bake::SourceMesh> mesh = load_text(
        "m.gltf",
        gltf_text(
            bytes,
            fmt::format(R"("bufferViews":[{{"buffer":0,"byteLength":36}}],)"
                        R"("accessors":[{{"bufferView":0,"componentType":5126,"type":"VEC3","count":3}}],)"
                        R"("materials":[{},{{"normalTexture":{{"index":0}}}}],)"
                        R"("meshes":[{{"primitives":[{{"attributes":{{"POSITION":0}},"material":0{}}}]}}]{})",
                        material, primitive, members)));
    EXPECT_TRUE(mesh) << (mesh ? "" : mesh.error().message);
    std::vector<std::string> lost;
    for (const bake::SourceNote& note : mesh ? mesh->notes : std::vector<bake::SourceNote>()) {
        EXPECT_EQ(note.kind, bake::SourceNote::Kind::Lost);
        lost.push_back(note.text);
    }
    return lost;
}

TEST(GltfLosses, are_reported_with_counts_for_drawn_materials) {
    EXPECT_TRUE(lost_of("{}").empty()) << "the other material is not drawn";
    const auto one = [](const std::vector<std::string>& lost) { return lost.size() == 1 ? lost[0] : ""; };
    EXPECT_EQ(one(lost_of(R"({"normalTexture":{"index":0}})")).find("the normal maps of 1 material:"), 0U);
    EXPECT_EQ(one(lost_of(R"({"occlusionTexture":{"index":0}})")).find("the occlusion maps of 1 material:"),
              0U);
    EXPECT_EQ(one(lost_of(R"({"emissiveFactor":[0,0.5,0]})")).find("the light that 1 material gives"), 0U);
    EXPECT_TRUE(lost_of(R"({"emissiveFactor":[0,0,0],"emissiveTexture":{"index":0}})").empty())
        << "black times a picture is black";
    EXPECT_TRUE(lost_of("{}", R"(,"animations":[{},{},{}])").empty()) << "they move nothing";
    EXPECT_EQ(
        one(lost_of("{}", "", R"(,"targets":[{"POSITION":0},{"POSITION":0}])")).find("2 shapes to change"),
        0U);
}

} // namespace
} // namespace frustumscreen::testing
