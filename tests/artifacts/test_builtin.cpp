#include "assets_baked/artifacts/builtin.h"
#include "assets_baked/artifacts/write_glb.h"
#include "assets_baked/bake/hotspots.h"
#include "assets_baked/bake/last_look.h"
#include "assets_baked/bake/loaders/load_bytes.h"
#include "assets_baked/folder/artifact_file.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdlib>
#include <map>
#include <set>
#include <string>
#include <tuple>
#include <utility>

namespace frustumscreen::artifacts {
namespace {

using Edge = std::pair<std::uint32_t, std::uint32_t>;

/// Each is built once for all tests.
const bake::SourceMesh& built(std::string_view name, std::int64_t triangles) {
    static std::map<std::pair<std::string_view, std::int64_t>, bake::SourceMesh> meshes;
    auto& mesh = meshes[{name, triangles}];
    if (mesh.triangles.empty()) {
        mesh = make_builtin(name, triangles).value();
    }
    return mesh;
}

/// Vertices at one place become one number: seams of the texture do not count.
std::vector<std::uint32_t> places_of(const bake::SourceMesh& mesh) {
    std::map<std::tuple<double, double, double>, std::uint32_t> numbers;
    std::vector<std::uint32_t> places;
    for (const glm::dvec3& p : mesh.positions) {
        places.push_back(
            numbers.try_emplace({p.x, p.y, p.z}, static_cast<std::uint32_t>(numbers.size())).first->second);
    }
    return places;
}

/// Where the ray from `origin` along `direction` first meets the mesh: which side it sees. Plain arithmetic.
struct Sight {
    double t = 1e30;
    bool front = false;
    glm::vec2 uv{0.0F};
};
Sight look(const bake::SourceMesh& mesh, const glm::dvec3& origin, const glm::dvec3& direction) {
    Sight sight;
    for (const auto& triangle : mesh.triangles) {
        const glm::dvec3 a = mesh.positions[triangle[0]];
        const glm::dvec3 ab = mesh.positions[triangle[1]] - a;
        const glm::dvec3 ac = mesh.positions[triangle[2]] - a;
        const glm::dvec3 normal = glm::cross(ab, ac);
        const double slope = glm::dot(normal, direction);
        if (slope == 0.0) {
            continue;
        }
        const double t = glm::dot(normal, a - origin) / slope;
        const glm::dvec3 offset = origin + t * direction - a;
        const double u = glm::dot(normal, glm::cross(offset, ac)) / glm::dot(normal, normal);
        const double v = glm::dot(normal, glm::cross(ab, offset)) / glm::dot(normal, normal);
        if (t > 0.0 && t < sight.t && u >= 0.0 && v >= 0.0 && u + v <= 1.0) {
            sight = {t, slope < 0.0, mesh.uvs[triangle[0]]};
        }
    }
    return sight;
}

class EveryBuiltin : public testing::TestWithParam<std::string_view> {};

TEST_P(EveryBuiltin, HasTheRequestedNumberOfTriangles) {
    for (const std::int64_t triangles : {1'000, 8'000, 400'000}) {
        const bake::SourceMesh& mesh = built(GetParam(), triangles);
        EXPECT_NEAR(static_cast<double>(mesh.triangles.size()), static_cast<double>(triangles),
                    0.05 * static_cast<double>(triangles));
    }
}

TEST_P(EveryBuiltin, IsDeterministic) {
    const bake::SourceMesh& a = built(GetParam(), 8'000);
    const bake::SourceMesh b = make_builtin(GetParam(), 8'000).value();
    EXPECT_EQ(a.positions, b.positions);
    EXPECT_EQ(a.uvs, b.uvs);
    EXPECT_EQ(a.triangles, b.triangles);
    EXPECT_EQ(a.textures[0].image->texels, b.textures[0].image->texels);
}

TEST_P(EveryBuiltin, IsAValidMesh) {
    const bake::SourceMesh& mesh = built(GetParam(), 8'000);
    ASSERT_EQ(mesh.uvs.size(), mesh.positions.size());
    ASSERT_EQ(mesh.triangle_materials.size(), mesh.triangles.size());
    ASSERT_EQ(mesh.materials.size(), 1U);
    ASSERT_EQ(mesh.textures.size(), 1U);
    EXPECT_LE(mesh.textures[0].image->width, 2048);
    EXPECT_EQ(mesh.default_up, 'y');
    for (const glm::dvec3& position : mesh.positions) {
        ASSERT_TRUE(std::isfinite(position.x) && std::isfinite(position.y) && std::isfinite(position.z));
        ASSERT_EQ(position, glm::dvec3(glm::vec3(position))) << "a 32-bit file could not hold it";
        ASSERT_GE(position.y, -1e-3) << "it stands on y = 0";
    }
    for (const glm::vec2& uv : mesh.uvs) {
        ASSERT_TRUE(uv.x >= 0.0F && uv.x <= 4.0F && uv.y >= 0.0F && uv.y <= 1.0F);
    }
    for (const auto& triangle : mesh.triangles) {
        for (const std::uint32_t corner : triangle) {
            ASSERT_LT(corner, mesh.positions.size());
        }
    }
}

TEST_P(EveryBuiltin, HasConsistentWinding) {
    const bake::SourceMesh& mesh = built(GetParam(), 8'000);
    const std::vector<std::uint32_t> places = places_of(mesh);
    std::set<Edge> edges;
    for (const auto& triangle : mesh.triangles) {
        for (std::size_t i = 0; i < 3; ++i) {
            const Edge edge = {places[triangle[i]], places[triangle[(i + 1) % 3]]};
            if (edge.first != edge.second) {
                EXPECT_TRUE(edges.insert(edge).second)
                    << "two triangles run along an edge in the same direction";
            }
        }
    }
}

TEST_P(EveryBuiltin, ShowsFrontFacesFromAllSides) {
    const bake::SourceMesh& mesh = built(GetParam(), 8'000);
    int seen = 0;
    for (int azimuth = 0; azimuth < 360; azimuth += 20) {
        for (int height = 10; height < 320; height += 15) {
            const double angle = (azimuth + 7.3) * 0.017453292519943295;
            const glm::dvec3 away = {std::cos(angle), 0.35, std::sin(angle)};
            const Sight sight = look(mesh, glm::dvec3(0.0, height, 0.0) + 500.0 * away, -away);
            if (sight.t < 1e29) {
                ++seen;
                EXPECT_TRUE(sight.front) << "a back at azimuth " << azimuth << ", height " << height;
            }
        }
    }
    EXPECT_GT(seen, 100);
}

folder::ArtifactFile folder_of(std::string_view name) {
    const Result<folder::ArtifactFile> file =
        folder::parse_artifact_file(builtin_folder_text(name), folder::artifact_file_name);
    EXPECT_TRUE(file) << (file ? "" : file.error().message);
    return file.value_or(folder::ArtifactFile{});
}

TEST_P(EveryBuiltin, HasAllItsTextsInFiveLanguages) {
    const folder::ArtifactFile file = folder_of(GetParam());
    EXPECT_EQ(file.scan, std::string(GetParam()) + ".glb");
    ASSERT_EQ(file.texts.size(), 5U);
    std::set<std::string> seen;
    for (std::size_t k = 0; k < 5; ++k) {
        const pack::PackCaption& caption = file.texts[k];
        EXPECT_EQ(caption.language, (std::array{"en", "de", "fr", "es", "el"}.at(k)));
        for (const std::string& text : {caption.title, caption.text, caption.period, caption.place,
                                        caption.maker, caption.credit, caption.description}) {
            EXPECT_FALSE(text.empty()) << caption.language;
            EXPECT_EQ(text.find('\t'), std::string::npos);
        }
        EXPECT_TRUE(seen.insert(caption.text).second && seen.insert(caption.description).second)
            << caption.language;
    }
}

TEST_P(EveryBuiltin, HasAPictureForEachLayerAndTitlesInFiveLanguages) {
    const std::vector<BuiltinLayer> layers = builtin_layers(GetParam());
    std::set<std::string> named;
    for (const folder::ArtifactTorch& content : folder_of(GetParam()).torches) {
        EXPECT_EQ(content.titles.size(), 5U) << content.name;
        for (const folder::ArtifactTorchStage& stage : content.stages) {
            if (!stage.file.empty()) {
                named.insert(stage.file.string());
            }
        }
    }
    for (const folder::ArtifactState& state : folder_of(GetParam()).states) {
        EXPECT_EQ(state.titles.size(), 5U) << state.name;
        if (state.layer) {
            EXPECT_TRUE(named.contains(state.layer->file.string())) << "the torch's layer, not one more";
        }
    }
    EXPECT_EQ(named.size(), layers.size());
    const image::Image8& own = *built(GetParam(), 8'000).textures.front().image;
    for (const BuiltinLayer& layer : layers) {
        EXPECT_TRUE(named.contains(std::string(layer.file))) << layer.file;
        EXPECT_EQ(layer.picture.width, own.width);
        EXPECT_EQ(layer.picture.height, own.height);
        EXPECT_NE(layer.picture.texels, own.texels);
    }
}

TEST_P(EveryBuiltin, HasTwoOutwardHotspotsOnItsSurface) {
    const bake::SourceMesh& mesh = built(GetParam(), 8'000);
    const Result<bake::BoxFrame> frame = bake::make_box_frame(mesh, {"y", 0.0, 0.0});
    ASSERT_TRUE(frame);
    const std::vector<glm::dvec3> points = bake::in_box(mesh, *frame);
    const bake::SourceScene scene(mesh, points);
    const folder::ArtifactFile file = folder_of(GetParam());
    ASSERT_EQ(file.hotspots.size(), 2U);
    for (const folder::ArtifactHotspot& given : file.hotspots) {
        ASSERT_EQ(given.labels.size(), 5U);
        const Result<pack::PackHotspot> hotspot =
            bake::put_on_surface({given.place, given.point_file, given.labels}, scene, *frame, {});
        ASSERT_TRUE(hotspot) << hotspot.error().message;
        const glm::dvec3 wanted(frame->box_from_file * glm::dvec4(given.point_file, 1.0));
        EXPECT_LT(glm::distance(wanted, hotspot->point), 0.02) << given.place;
        // A ray from outside along the normal meets the front of the surface there.
        const glm::dvec3 outward = glm::transpose(frame->turned_from_file) * hotspot->normal;
        const Sight sight = look(mesh, given.point_file + 300.0 * outward, -outward);
        EXPECT_NEAR(sight.t, 300.0, 8.0) << given.place;
        EXPECT_TRUE(sight.front) << given.place;
    }
}

INSTANTIATE_TEST_SUITE_P(Artifacts, EveryBuiltin, testing::ValuesIn(builtin_names()), [](const auto& test) {
    return test.param == "amphora" ? "Amphora" : "NautilusCup";
});

TEST(Amphora, IsClosedExceptAtItsHandles) {
    const bake::SourceMesh& mesh = built("amphora", 8'000);
    const std::vector<std::uint32_t> places = places_of(mesh);
    std::map<Edge, int> balance;
    for (const auto& triangle : mesh.triangles) {
        for (std::size_t i = 0; i < 3; ++i) {
            const std::uint32_t a = places[triangle[i]];
            const std::uint32_t b = places[triangle[(i + 1) % 3]];
            balance[std::minmax(a, b)] += a < b ? 1 : -1;
        }
    }
    // The handles' ends are open, inside the wall.
    for (const auto& [edge, sum] : balance) {
        if (sum != 0) {
            std::size_t vertex = 0;
            while (places[vertex] != edge.first) {
                ++vertex;
            }
            EXPECT_GT(mesh.positions[vertex].y, 200.0);
        }
    }
}

TEST(Amphora, IsHollowWithGapsBehindItsHandles) {
    const bake::SourceMesh& mesh = built("amphora", 8'000);
    const Sight into_the_mouth = look(mesh, {0.5, 600.0, 0.5}, {0.0, -1.0, 0.0});
    EXPECT_GT(into_the_mouth.t, 400.0) << "deeper than the neck";
    EXPECT_TRUE(into_the_mouth.front);
    for (const double x : {-60.0, 60.0}) {
        EXPECT_GT(look(mesh, {x, 272.0, 500.0}, {0.0, 0.0, -1.0}).t, 1e29) << "between neck and handle";
    }
    EXPECT_LT(look(mesh, {84.0, 272.0, 500.0}, {0.0, 0.0, -1.0}).t, 1e29) << "on the handle";
}

TEST(Amphora, HasReliefInTheFrieze) {
    // Radii around one height in the frieze: a plain turned body would have one.
    const bake::SourceMesh& mesh = built("amphora", 400'000);
    double least = 1e9;
    double most = 0.0;
    for (const glm::dvec3& p : mesh.positions) {
        const double radius = std::hypot(p.x, p.z);
        if (std::abs(p.y - 178.0) < 0.5 && radius > 90.0) {
            least = std::min(least, radius);
            most = std::max(most, radius);
        }
    }
    EXPECT_GT(most - least, 0.4);
    EXPECT_LT(most - least, 2.0);
}

TEST(NautilusCup, IsThinAndConcave) {
    const bake::SourceMesh& mesh = built("nautilus-cup", 8'000);
    const Sight from_above = look(mesh, {35.0, 600.0, 0.5}, {0.0, -1.0, 0.0});
    const double inner_floor = 600.0 - from_above.t;
    const Sight from_below = look(mesh, {35.0, 5.0 + 30.0, 0.5}, {0.0, 1.0, 0.0});
    const double outer_floor = 35.0 + from_below.t;
    EXPECT_LT(inner_floor, 150.0);
    EXPECT_GT(inner_floor - outer_floor, 0.5);
    EXPECT_LT(inner_floor - outer_floor, 4.0);
}

TEST(Builtin, RejectsUnknownNamesAndInvalidCounts) {
    for (const auto& mesh :
         {make_builtin("vase", 5'000), make_builtin("amphora", 999), make_builtin("amphora", 50'000'001)}) {
        ASSERT_FALSE(mesh.has_value());
        EXPECT_EQ(mesh.error().message.find('\n'), std::string::npos);
        EXPECT_FALSE(mesh.error().message.empty());
    }
    EXPECT_TRUE(builtin_folder_text("vase").empty());
}

TEST(Builtin, LastLookReportsNothing) {
    std::size_t looks = 0;
    for (const std::string_view name : builtin_names()) {
        for (const std::int64_t triangles : {2'000, 100'000}) {
            // As a file has it, with 32-bit numbers, and as it is made.
            const Result<Bytes> file = write_glb(built(name, triangles));
            ASSERT_TRUE(file) << file.error().message;
            const Result<bake::SourceMesh> read = bake::load_mesh_bytes(*file, "artifact.glb");
            ASSERT_TRUE(read) << read.error().message;
            for (const bake::SourceMesh* mesh : {&built(name, triangles), &*read}) {
                const bake::Scraps scraps = bake::find_scraps(*mesh);
                EXPECT_EQ(scraps.triangles, 0U) << name;
                for (const bake::SourceNote& note : bake::last_look(*mesh, scraps, bake::Lighting::Museum)) {
                    ADD_FAILURE() << name << ", " << triangles << " triangles: " << note.text;
                }
                ++looks;
            }
            EXPECT_TRUE(read->notes.empty()) << read->notes.front().text;
        }
    }
    EXPECT_EQ(looks, 8U);
}

} // namespace
} // namespace frustumscreen::artifacts
