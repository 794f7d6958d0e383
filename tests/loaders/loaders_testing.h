/// Helpers of the loaders' tests: simple measures of a mesh, the index of the shared models.
#pragma once

#include "assets_baked/bake/load_mesh.h"
#include "firmware_host/base/file.h"
#include "tests/base/temporary_folder.h"

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace frustumscreen::testing {

/// Loads `text` as a file of that name, without other files next to it.
Result<bake::SourceMesh> load_text(const std::string& name, std::string_view text);
/// The error of a load that must fail; "" and a test failure if it does not.
std::string error_of(const Result<bake::SourceMesh>& mesh);

std::string base64(std::string_view bytes);
template <typename T> std::string bytes_of(const std::vector<T>& values) {
    return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T)};
}
/// A glTF text with one buffer of `bytes` (a data URI) before `members`.
std::string gltf_text(std::string_view bytes, std::string_view members);
/// Adds header and chunks to a JSON text.
std::string glb_bytes(std::string json, std::string binary);

struct Extent {
    glm::dvec3 low{1e300};
    glm::dvec3 high{-1e300};
};
Extent extent_of(const bake::SourceMesh& mesh);
double area_of(const bake::SourceMesh& mesh);
/// The signed volume: positive for a closed surface whose triangles run counter-clockwise seen from outside.
double volume_of(const bake::SourceMesh& mesh);
/// Checks the promises of load_mesh.
void expect_sound(const bake::SourceMesh& mesh);
/// The mesh of a load that must succeed, checked; an empty one and a test failure if it does not.
bake::SourceMesh sound(const Result<bake::SourceMesh>& mesh);
/// True if the mesh has a note of this kind with these words.
bool notes(const bake::SourceMesh& mesh, bake::SourceNote::Kind kind, std::string_view words);

struct IndexRow {
    std::string path;
    std::string format;
    std::string triangles;
    std::string notes;
};
std::filesystem::path shared_data();
bool has_shared_data();
std::vector<IndexRow> shared_index();

} // namespace frustumscreen::testing

#define FRUSTUMSCREEN_SKIP_WITHOUT_SHARED_DATA()                                                             \
    if (!::frustumscreen::testing::has_shared_data()) {                                                      \
        GTEST_SKIP() << "skipped: the folder of real models is not here: "                                   \
                     << ::frustumscreen::testing::shared_data();                                             \
    }
