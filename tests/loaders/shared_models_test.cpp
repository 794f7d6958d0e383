#include "tests/loaders/loaders_testing.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

namespace frustumscreen::testing {
namespace {

/// The index counts a mesh once; for instances a note gives the number of drawn triangles.
std::size_t triangles_drawn(const IndexRow& row) {
    const std::size_t note = row.notes.find(" tris drawn counting instances");
    if (note == std::string::npos) {
        return std::stoul(row.triangles);
    }
    const std::size_t begin = row.notes.find_last_not_of("0123456789", note - 1);
    return std::stoul(row.notes.substr(begin == std::string::npos ? 0 : begin + 1, note));
}

bool is_model(const IndexRow& row) {
    return row.path.starts_with("models/") && !row.format.starts_with("sidecar") && !row.triangles.empty();
}

bake::SourceMesh loaded(const std::string& path) {
    Result<bake::SourceMesh> mesh = bake::load_mesh(shared_data() / "models" / path);
    EXPECT_TRUE(mesh.has_value()) << (mesh ? "" : mesh.error().message);
    return mesh ? *std::move(mesh) : bake::SourceMesh{};
}

TEST(SharedModels, EveryModelLoadsWithTheTrianglesOfTheIndex) {
    FRUSTUMSCREEN_SKIP_WITHOUT_SHARED_DATA();
    int models = 0;
    for (const IndexRow& row : shared_index()) {
        if (!is_model(row)) {
            continue;
        }
        SCOPED_TRACE(row.path);
        const Result<bake::SourceMesh> mesh = bake::load_mesh(shared_data() / row.path);
        ASSERT_TRUE(mesh.has_value()) << mesh.error().message;
        expect_sound(*mesh);
        EXPECT_EQ(mesh->triangles.size(), triangles_drawn(row));
        EXPECT_EQ(mesh->default_up, row.format == "stl" ? 'z' : 'y');
        ++models;
    }
    EXPECT_GE(models, 30);
}

TEST(SharedModels, TheSixEncodingsOfNefertitiAreOneSurface) {
    FRUSTUMSCREEN_SKIP_WITHOUT_SHARED_DATA();
    const bake::SourceMesh obj = loaded("nefertiti_bust/nefertiti-lowres.obj");
    const Extent truth = extent_of(obj);
    const glm::dvec3 size = truth.high - truth.low;
    const double edge = std::max({size.x, size.y, size.z});
    EXPECT_EQ(obj.positions.size(), 35002U);
    for (const char* name : {"nefertiti-lowres_le.ply", "nefertiti_draco.glb", "nefertiti_float.glb",
                             "nefertiti_meshopt.glb", "nefertiti_quantized.glb"}) {
        SCOPED_TRACE(name);
        const bake::SourceMesh mesh = loaded(std::string("nefertiti_bust/") + name);
        const Extent extent = extent_of(mesh);
        EXPECT_EQ(mesh.triangles.size(), obj.triangles.size());
        // Draco's 14 bits are the coarsest of the six.
        for (int axis = 0; axis < 3; ++axis) {
            EXPECT_NEAR(extent.low[axis], truth.low[axis], edge / 8192.0);
            EXPECT_NEAR(extent.high[axis], truth.high[axis], edge / 8192.0);
        }
        EXPECT_NEAR(area_of(mesh) / area_of(obj), 1.0, 2e-3);
        EXPECT_NEAR(volume_of(mesh) / volume_of(obj), 1.0, 1e-3);
        EXPECT_GT(volume_of(mesh), 0.0);
    }
}

TEST(SharedModels, StlAndObjOfOneObjectAgree) {
    FRUSTUMSCREEN_SKIP_WITHOUT_SHARED_DATA();
    for (const auto& [obj, stl] :
         std::map<std::string, std::string>{{"goathead/goathead.obj", "goathead/goathead_bin.stl"},
                                            {"wingnut/wingnut.obj", "wingnut/wingnut_ascii.stl"}}) {
        const bake::SourceMesh a = loaded(obj);
        const bake::SourceMesh b = loaded(stl);
        EXPECT_EQ(a.triangles.size(), b.triangles.size());
        EXPECT_NEAR(area_of(a) / area_of(b), 1.0, 1e-5);
        EXPECT_NEAR(volume_of(a) / volume_of(b), 1.0, 1e-5);
    }
}

TEST(SharedModels, QuadsAndTrianglesOfTheSwordEncloseTheSameVolume) {
    FRUSTUMSCREEN_SKIP_WITHOUT_SHARED_DATA();
    const bake::SourceMesh triangles = loaded("oakeshott_sword/sword.obj");
    const bake::SourceMesh quads = loaded("oakeshott_sword/sword-quad-dominant.obj");
    EXPECT_NEAR(volume_of(quads) / volume_of(triangles), 1.0, 2e-3);
    EXPECT_NEAR(area_of(quads) / area_of(triangles), 1.0, 2e-3);
}

/// Mean base colour over the surface: the texel at each triangle's middle, weighted by area.
glm::dvec3 mean_colour(const bake::SourceMesh& mesh) {
    glm::dvec3 sum(0.0);
    double total = 0.0;
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        const auto& [a, b, c] = mesh.triangles[i];
        const bake::SourceMaterial& material = mesh.materials[mesh.triangle_materials[i]];
        const image::Image8& image = *mesh.textures.at(static_cast<std::size_t>(material.texture)).image;
        const glm::dvec2 uv = glm::dvec2(mesh.uvs[a] + mesh.uvs[b] + mesh.uvs[c]) / 3.0;
        const glm::dvec2 wrapped = uv - glm::floor(uv);
        const glm::u8vec4 texel =
            image.at(std::min(static_cast<int>(wrapped.x * image.width), image.width - 1),
                     std::min(static_cast<int>(wrapped.y * image.height), image.height - 1));
        const double area = glm::length(
            glm::cross(mesh.positions[b] - mesh.positions[a], mesh.positions[c] - mesh.positions[a]));
        sum += area * glm::dvec3(texel);
        total += area;
    }
    return sum / total;
}

TEST(SharedModels, TheCatHasOneColourInItsThreeEncodings) {
    FRUSTUMSCREEN_SKIP_WITHOUT_SHARED_DATA();
    const bake::SourceMesh jpeg = loaded("egyptian_cat_statue/cat_jpg.glb");
    const glm::dvec3 truth = mean_colour(jpeg);
    EXPECT_GT(glm::length(truth), 30.0) << "the cat is not black";
    for (const char* name : {"egyptian_cat_statue/cat.glb", "egyptian_cat_statue/cat_meshopt.glb"}) {
        SCOPED_TRACE(name);
        const bake::SourceMesh mesh = loaded(name);
        ASSERT_EQ(mesh.textures.size(), 1U) << "only the base colour is decoded";
        EXPECT_EQ(mesh.textures[0].image->width, 1024);
        EXPECT_LT(glm::length(mean_colour(mesh) - truth), 2.0);
        EXPECT_NEAR(area_of(mesh) / area_of(jpeg), 1.0, 1e-3);
    }
}

TEST(SharedModels, EveryFlightHelmetPartHasAPicture) {
    FRUSTUMSCREEN_SKIP_WITHOUT_SHARED_DATA();
    const bake::SourceMesh mesh = loaded("flight_helmet/FlightHelmet.gltf");
    for (const std::uint32_t material : mesh.triangle_materials) {
        ASSERT_GE(mesh.materials[material].texture, 0);
    }
    EXPECT_GE(mesh.textures.size(), 4U);
}

} // namespace
} // namespace frustumscreen::testing
