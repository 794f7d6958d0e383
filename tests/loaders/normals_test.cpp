// The file's own normals, by hand: they come with their corners, and those that are no directions refuse no file.
#include "tests/loaders/loaders_testing.h"

#include <gtest/gtest.h>

#include <limits>

namespace frustumscreen::testing {
namespace {

void expect_near(const glm::vec3& a, const glm::vec3& b) {
    EXPECT_LT(glm::length(a - b), 1e-6F) << a.x << " " << a.y << " " << a.z;
}

TEST(Normals, ObjCornersWithDifferentNormalsAreSplit) {
    const Result<bake::SourceMesh> mesh = load_text("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n"
                                                             "vn 0 0 2\nvn 0 -3 0\n"
                                                             "f 1//1 2//1 3//1\nf 1//-1 4//-1 2//-1\n");
    ASSERT_TRUE(mesh) << mesh.error().message;
    ASSERT_EQ(mesh->positions.size(), 6U) << "two corners of each are shared in place and not in normal";
    ASSERT_EQ(mesh->normals.size(), 6U);
    for (const std::uint32_t corner : mesh->triangles[0]) {
        expect_near(mesh->normals[corner], {0, 0, 1});
    }
    for (const std::uint32_t corner : mesh->triangles[1]) {
        expect_near(mesh->normals[corner], {0, -1, 0});
    }
}

TEST(Normals, OmitsMissingOrInvalidObjNormals) {
    const Result<bake::SourceMesh> mesh =
        load_text("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n"
                           "vn nan 0 1\nvn a b c\nvn 0 1\n"
                           "f 1//1 2//7 3//0\nf 1/ 2//x 3//2\nf 1//3 2 3\n");
    ASSERT_TRUE(mesh) << mesh.error().message;
    expect_sound(*mesh);
    ASSERT_EQ(mesh->normals.size(), mesh->positions.size());
    expect_near(mesh->normals[mesh->triangles[0][0]], {0, 0, 0});
    expect_near(mesh->normals[mesh->triangles[0][1]], {0, 0, 0});
    expect_near(mesh->normals[mesh->triangles[2][0]], {0, 1, 0});
    const Result<bake::SourceMesh> plain =
        load_text("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 0 1\nf 1 2 3\n");
    ASSERT_TRUE(plain);
    EXPECT_TRUE(plain->normals.empty()) << "no face names a normal";
}

TEST(Normals, ReadsBothSpellingsOfPlyNormals) {
    for (const auto& [x, y, z] :
         {std::array{"nx", "ny", "nz"}, std::array{"normal_x", "normal_y", "normal_z"}}) {
        const std::string text = fmt::format(
            "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
            "property float {}\nproperty float {}\nproperty float {}\n"
            "element face 1\nproperty list uchar int vertex_indices\nend_header\n"
            "0 0 0 0 0 2\n1 0 0 0 0 0\n0 1 0 0 -1 0\n3 0 1 2\n",
            x, y, z);
        const Result<bake::SourceMesh> mesh = load_text("a.ply", text);
        ASSERT_TRUE(mesh) << mesh.error().message;
        ASSERT_EQ(mesh->normals.size(), 3U);
        expect_near(mesh->normals[0], {0, 0, 1});
        expect_near(mesh->normals[1], {0, 0, 0});
        expect_near(mesh->normals[2], {0, -1, 0});
    }
}

/// A triangle in a node with this transform.
std::string gltf_with_normals(const std::vector<float>& normals, const std::string& node) {
    const std::vector<float> positions{0, 0, 0, 1, 0, 0, 0, 1, 0};
    return gltf_text(
        bytes_of(positions) + bytes_of(normals),
        fmt::format(
            R"("bufferViews":[{{"buffer":0,"byteLength":36}},{{"buffer":0,"byteOffset":36,"byteLength":{}}}],)"
            R"("accessors":[{{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"}},)"
            R"({{"bufferView":1,"componentType":5126,"count":{},"type":"VEC3"}}],)"
            R"("meshes":[{{"primitives":[{{"attributes":{{"POSITION":0,"NORMAL":1}}}}]}}],)"
            R"("nodes":[{{"mesh":0{}}}])",
            4 * normals.size(), normals.size() / 3, node));
}

TEST(Normals, GltfNormalsStayPerpendicularUnderScale) {
    // The plane x + z = 1 stretched by 2 along x is x / 2 + z = 1, with the normal (1, 0, 2).
    const std::vector<float> normals{1, 0, 1, 1, 0, 1, 1, 0, 1};
    const Result<bake::SourceMesh> mesh =
        load_text("a.gltf", gltf_with_normals(normals, R"(,"scale":[2,1,1])"));
    ASSERT_TRUE(mesh) << mesh.error().message;
    ASSERT_EQ(mesh->normals.size(), 3U);
    expect_near(mesh->normals[0], glm::normalize(glm::vec3(1, 0, 2)));
    const Result<bake::SourceMesh> flat =
        load_text("a.gltf", gltf_with_normals(normals, R"(,"scale":[2,0,1])"));
    ASSERT_TRUE(flat) << flat.error().message;
    expect_near(flat->normals[0], {0, 0, 0});
}

TEST(Normals, InvalidGltfNormalsDoNotRejectTheFile) {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const Result<bake::SourceMesh> mesh =
        load_text("a.gltf", gltf_with_normals({nan, 0, 1, 0, 0, 1, 0, 0, 1}, ""));
    ASSERT_TRUE(mesh) << mesh.error().message;
    ASSERT_EQ(mesh->normals.size(), 3U);
    expect_near(mesh->normals[0], {0, 0, 0});
    expect_near(mesh->normals[1], {0, 0, 1});
    const Result<bake::SourceMesh> fewer = load_text("a.gltf", gltf_with_normals({0, 0, 1, 0, 0, 1}, ""));
    ASSERT_TRUE(fewer) << fewer.error().message;
    EXPECT_TRUE(fewer->normals.empty());
}

} // namespace
} // namespace frustumscreen::testing
