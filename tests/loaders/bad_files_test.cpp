/// Every file of the shared collection of bad models gives its expected error or is usable.
#include "tests/loaders/loaders_testing.h"

#include <gtest/gtest.h>

#include <set>

namespace frustumscreen::testing {
namespace {

struct BadFile {
    const char* path;
    const char* says; ///< part of the error's line; nullptr: usable nevertheless
    std::size_t triangles = 0;
};

constexpr BadFile bad_files[] = {
    {"assimp/IndexOutOfRange/IndexOutOfRange.gltf",
     "contradict each other (meshes[0].primitives[0].indices: element"},
    {"assimp/MissingBin/BoxTextured.gltf", "\"BoxTextured0.bin\", but there is no such file beside it"},
    {"assimp/TestNoRootNode/NoScene.gltf", "scene: 0 is out of range, the file has 0"},
    {"assimp/invalid/empty.ply", "[mesh.empty_file]"},
    {"assimp/invalid/malformed.obj", "line 23: vertex 12 is out of range"},
    {"assimp/wrongTypes/badArray.gltf", "array is expected"},
    {"khronos_validator//index_buffer_oob.gltf",
     "contradict each other (meshes[0].primitives[0].indices: element"},
    {"khronos_validator//invalid_elements_float.gltf", "no triangles"},
    {"khronos_validator//joints_no_weights.gltf", "bufferViews["},
    {"khronos_validator/accessor/alignment.gltf", "accessors[2]"},
    {"khronos_validator/accessor/small_stride.gltf", "accessors[0]: its elements have 16 bytes"},
    {"khronos_validator/asset/1_0_version.gltf", "glTF 1.0 cannot be read"},
    {"khronos_validator/buffer/invalid_uri_data_bytelength.gltf", "buffers["},
    {"khronos_validator/buffer/no_bin_chunk.glb", "buffers[0]: has no data"},
    {"khronos_validator/buffer_view/invalid_stride_too_big.gltf", "bufferViews[0].byteStride"},
    {"khronos_validator/glb/chunk_too_big.glb", "GLB "},
    {"khronos_validator/glb/invalid_magic.glb", "[mesh.no_gltf]"},
    {"khronos_validator/glb/invalid_version.glb", "GLB of version 0 cannot be read"},
    {"khronos_validator/glb/truncated_chunk_data.glb", "the file ends too early (GLB "},
    {"khronos_validator/image/invalid_image_data.gltf", "no triangles"},
    {"khronos_validator/image/not_found.gltf", "no triangles"},
    {"khronos_validator/image/png_eos.gltf", "no triangles"},
    {"khronos_validator/mesh/accessor_unequal_count.gltf", "COLOR_0: 4 elements, but POSITION has 3"},
    {"khronos_validator/node/matrix_trs.gltf", "nodes[0]: has a matrix and"},
    {"khronos_validator/node/node_loop.gltf", "is its own ancestor"},
    {"khronos_validator/node/unresolved_mesh.gltf", "nodes[0].mesh: 0 is out of range"},
    {"tri/emptyIO/stl_empty_bin.stl", "no triangles"},
    // Holes and flipped facets are handled by the bake.
    {"tri/models/busted.STL", nullptr, 3878},
    {"tri/models/negative_indices.obj", nullptr, 12},
    // Its face with two corners shows nothing and is skipped; the triangle is loaded.
    {"tri/models/notenoughindices.obj", nullptr, 1},
};

TEST(BadFiles, EachIsRejectedInOneLineOrUsable) {
    FRUSTUMSCREEN_SKIP_WITHOUT_SHARED_DATA();
    for (const BadFile& file : bad_files) {
        SCOPED_TRACE(file.path);
        const std::filesystem::path path = shared_data() / "bad" / file.path;
        const Result<bake::SourceMesh> mesh = bake::load_mesh(path);
        if (file.says == nullptr) {
            ASSERT_TRUE(mesh.has_value()) << mesh.error().message;
            expect_sound(*mesh);
            EXPECT_EQ(mesh->triangles.size(), file.triangles);
            continue;
        }
        const std::string error = error_of(mesh);
        EXPECT_EQ(error.find(path.string() + ": "), 0U) << error;
        EXPECT_NE(error.find(file.says), std::string::npos) << error;
        EXPECT_EQ(error.find_first_of("\r\n"), std::string::npos) << error;
    }
}

TEST(BadFiles, TheTableNamesEveryBadModelOfTheIndex) {
    FRUSTUMSCREEN_SKIP_WITHOUT_SHARED_DATA();
    std::set<std::string> named;
    for (const BadFile& file : bad_files) {
        named.insert(std::string("bad/") + file.path);
    }
    for (const IndexRow& row : shared_index()) {
        const bool is_model = row.path.starts_with("bad/") && !row.format.starts_with("sidecar") &&
                              !row.format.starts_with("expected");
        EXPECT_TRUE(!is_model || named.contains(row.path)) << row.path;
    }
}

} // namespace
} // namespace frustumscreen::testing
